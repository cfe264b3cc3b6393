"""Draws the pictures of Hagen's programs with matplotlib; see Drawing.h.

Reads jobs from standard input: a line of JSON, then the arrays listed in it (type, shape). Answers each with a line,
which is empty or says what went wrong. `kind` names the function that draws a job.
"""
import json
import logging
import os
import sys
import warnings

sys.path[:] = [folder for folder in sys.path if folder]  # never import from the working folder
logging.disable()  # for example of a home folder that is not writable
warnings.simplefilter("ignore")
DEBIAN = "/usr/bin/python3"
try:
    import matplotlib
    import numpy as np
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.legend_handler import HandlerTuple
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle
    from matplotlib.ticker import LogLocator, NullFormatter
except ImportError:
    with open("/proc/self/cmdline", encoding="utf-8") as file:
        words = file.read().split("\0")[1:-1]
    if len(sys.argv) == 1 and os.path.exists(DEBIAN):  # another Python comes first in PATH
        os.execv(DEBIAN, [DEBIAN, *words, "again"])
    print("pictures require matplotlib, which python3 does not find; on Debian: apt-get install python3-matplotlib")
    sys.exit()

INK, FAINT, LINES, EMPTY, ROU = "#333333", "#666666", "#DDDDDD", "#E9E9E9", "#A9BCCB"
# Colour-blind safe (Okabe and Ito).
COLOURS = ["#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#7A1F5C"]
LONE = "#777777"  # RoI returns of no obstacle
CHART_COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", INK, "#56B4E9"]
LABELLED = 5  # obstacles with their distance
MAX_BARS, MAX_COMPONENTS = 60, 12
AZIMUTH = "azimuth [°], 0 straight ahead, left of the sensor on the left"


def plain(text, most=90):
    """One line without mathematics."""
    text = " ".join(text.split())
    return (text if len(text) <= most else text[:most] + " ...").replace("$", r"\$")


def rgb(colours):
    return np.array([[int(colour[i:i + 2], 16) for i in (1, 3, 5)] for colour in colours], np.uint8)


class Page:
    """A picture; positions are pixels from the lower left corner."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.figure = Figure(figsize=(width / 100, height / 100), dpi=100)
        FigureCanvasAgg(self.figure)

    def text(self, x, y, text, **style):
        return self.figure.text(x / self.width, y / self.height, text, **{"color": INK, **style})

    def heading(self, heading, remark, title):
        y = self.height - 24
        drawn = self.text(12, y, heading, fontsize=13, weight="bold")
        end = drawn.get_window_extent(self.figure.canvas.get_renderer()).x1
        self.text(end + 12, y, remark, fontsize=8.5, color=FAINT)
        self.text(self.width - 12, y, plain(title), color=FAINT, ha="right")

    def axes(self, left, right, bottom, top, title=""):
        axes = self.figure.add_axes((left / self.width, bottom / self.height, (right - left) / self.width,
                                     (top - bottom) / self.height))
        axes.spines[["top", "right"]].set_visible(False)
        axes.set_title(title, pad=5)
        return axes

    def colour_bar(self, image, what, box):
        self.figure.colorbar(image, cax=self.axes(*box), label=what).outline.set_visible(False)

    def save(self, path):  # a temporary name may lack the extension of a PNG
        how = ({"format": "svg", "metadata": {"Date": None}} if path.endswith(".svg")
               else {"format": "png", "pil_kwargs": {"compress_level": 1}})
        try:
            self.figure.savefig(path, **how)
        except OSError as error:
            raise RuntimeError(f"{path} could not be written: {error.strerror}") from error


class Scan:
    """A job of kind `stages`; draws the panels of its pictures."""

    def __init__(self, job):
        self.__dict__.update(job)
        self.rows, self.columns = self.depth_m.T.shape
        self.azimuth = 180 - 360 * (self.column + 0.5) / self.columns
        near = self.depth_m[np.isfinite(self.depth_m)]
        self.far = float(np.quantile(near, 0.99)) if near.size else self.zone_m
        self.colour = self.colours()
        # Returns are renumbered; pixels take the numbers of their returns.
        number = np.arange(self.components.max() + 1)
        known = (self.pixel_of_return >= 0) & (self.component > 0)
        number[self.components.ravel()[self.pixel_of_return[known]]] = self.component[known]
        self.label_image = rgb([EMPTY, ROU, ROU])[self.labels]
        is_roi = self.labels == 2
        number = np.minimum(number, len(self.boxes))  # pixels whose returns are all ROU
        self.label_image[is_roi] = rgb([*COLOURS, LONE])[self.colour[number[self.components[is_roi]]]]
        # The top view shows the obstacles and the near ground, and at most the zone.
        far = np.maximum(np.abs(self.x_m), np.abs(self.y_m))
        far[~np.isfinite(far)] = np.inf
        near_ground = (self.label == 1) & (far < self.zone_m)
        reach = [np.quantile(far[some], share) for some, share in (
            ((self.label == 2) & (far < np.inf), 0.995), (near_ground, 0.5)) if some.any()]
        self.half = 1.08 * min(max(reach, default=self.zone_m), self.zone_m)
        shown = np.flatnonzero(far < self.half)
        cell = np.round(np.stack([self.x_m, self.y_m])[:, shown] / self.half * 400).astype(int)  # draws each once
        key = (801 * cell[0] + cell[1]) * 4 + self.label[shown]
        self.shown = shown[np.unique(key, return_index=True)[1]]

    def colours(self):
        """Index of the colour of each obstacle: the colour that is farthest away in the pictures."""
        low, high = self.boxes[:, 2:4], self.boxes[:, 4:6]
        middle, half = (low + high) / 2, (high - low) / 2
        azimuth = np.arctan2(middle[:, 1], middle[:, 0])
        width = np.arctan2(np.hypot(*half.T), np.hypot(*middle.T))
        returns = np.bincount(self.component, minlength=len(low) + 1)[1:]
        returns[:1] = len(self.component) + 1  # the nearest has the first colour, then the largest choose
        order = np.argsort(-returns, kind="stable")
        colour = np.zeros(len(low) + 1, int)
        for chosen, i in enumerate(order[1:], 1):
            others = order[:chosen]
            gap = np.hypot(*np.maximum(np.abs(middle[others] - middle[i]) - half[others] - half[i], 0).T)
            turn = np.abs((azimuth[others] - azimuth[i] + np.pi) % (2 * np.pi) - np.pi) - width[others] - width[i]
            distance = np.minimum(gap, 5 * np.maximum(turn, 0)) + 1e-3 * np.hypot(*(middle[others] - middle[i]).T)
            nearest = [distance[colour[others + 1] == c].min(initial=np.inf) for c in range(len(COLOURS))]
            colour[i + 1] = int(np.argmax(nearest))
        colour[0] = len(COLOURS)
        return colour

    def image_axes(self, page, box, title="", has_azimuth=True, is_zoomed=False, beams=6):
        axes = page.axes(*box, title)
        axes.set_facecolor(EMPTY)
        middle = min(max(self.azimuth, -150), 150) if is_zoomed else 0
        half, step = (30, 10) if is_zoomed else (180, 45)
        axes.set_xlim(middle + half, middle - half)
        axes.set_xticks([a for a in range(-180, 181, step) if abs(a - middle) <= half])
        axes.set_ylim(-0.5, self.rows - 0.5)
        self.beam_ticks(axes.yaxis, beams)
        axes.set_ylabel("elevation [°]")
        if has_azimuth:
            axes.set_xlabel("azimuth [°]" if is_zoomed else AZIMUTH)
        else:
            axes.set_xticklabels([])
        return axes

    def beam_ticks(self, axis, beams):
        rows = np.unique(np.linspace(0, self.rows - 1, beams).round().astype(int))
        axis.set_ticks(rows, [f"{round(np.degrees(self.elevations_rad[row]), 1) + 0:g}" for row in rows])

    def image(self, axes, image, **style):
        bottom = (self.rows - image.shape[1]) / 2 - 0.5  # an angle lies between two beams
        return axes.imshow(image.swapaxes(0, 1), origin="lower", aspect="auto", interpolation="nearest",
                           extent=(180, -180, bottom, bottom + image.shape[1]), **style)

    def distances(self, page, box, image, title="", bar_bottom=None, **which):
        axes = self.image_axes(page, box, title, **which)
        drawn = self.image(axes, image, cmap="viridis", vmin=0, vmax=self.far)
        if bar_bottom:
            page.colour_bar(drawn, "distance [m]", (box[1] + 10, box[1] + 24, bar_bottom, box[3]))
        return axes

    def angles(self, page, box, image, title="", bar_bottom=None, has_mark=False, **which):
        axes = self.image_axes(page, box, title, **which)
        drawn = self.image(axes, np.degrees(image), cmap="cividis", vmin=0, vmax=90)
        if bar_bottom:
            page.colour_bar(drawn, "angle [°]", (box[1] + 10, box[1] + 24, bar_bottom, box[3]))
        if has_mark:
            axes.plot(self.azimuth, 1 + 7 / (box[3] - box[2]), "v", ms=7, color=COLOURS[0], mew=0, clip_on=False,
                      transform=axes.get_xaxis_transform())

    def maxima_image(self, page, box, title="", **which):
        axes = self.distances(page, box, self.repaired_m, title, **which)
        azimuth = 180 - 360 * (self.maxima[:, 0] + 0.5) / self.columns
        axes.plot(azimuth, self.maxima[:, 1], "o", ms=4, color="white", mec="black", mew=0.8, clip_on=False)

    def label_panel(self, page, box, title="", **which):
        axes = self.image_axes(page, box, title, **which)
        self.image(axes, self.label_image)
        return axes

    def barcode(self, page, box):
        birth, death = self.maxima[:, 2:4].T
        longest = np.sort(np.argsort(death - birth, kind="stable")[:MAX_BARS])  # oldest first
        few = f"{MAX_BARS} longest of " if len(birth) > MAX_BARS else ""
        axes = page.axes(*box, f"{few}{len(birth)} maxima from birth to death")
        axes.hlines(np.arange(len(longest)), death[longest], birth[longest], color="#3B528B",
                    lw=min(max(200 / max(len(longest), 1), 1), 5))
        axes.set_xlim(self.zone_m, 0)
        axes.set_ylim(max(len(longest), 1), -1)
        axes.set_yticks([])
        axes.set_xlabel(f"proximity [m]: {self.zone_m:g} m minus the distance")

    def series(self, page, box):
        axes = page.axes(*box, f"Column at {self.azimuth:.1f}°")
        row = np.arange(self.rows - 1) + 0.5
        axes.plot(row, np.degrees(self.angle_rad[self.column]), "o-", ms=8, lw=4, color="#BBBBBB", label="before")
        axes.plot(row, np.degrees(self.smoothed_rad[self.column]), "o-", ms=4, color="#0072B2", label="after")
        axes.set_xlim(-0.5, self.rows - 0.5)
        self.beam_ticks(axes.xaxis, 6)
        axes.set_xlabel("elevation [°]")
        axes.set_ylabel("range angle [°]")
        axes.grid(axis="y")
        axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2, borderpad=0)

    def principal_components(self, page, box):
        axes = page.axes(*box, f"Principal components, {self.kept} of {self.window_size} kept (blue)")
        axes.set_xlim(-0.5, self.rows - 0.5)
        self.beam_ticks(axes.xaxis, 6)
        axes.set_xlabel("elevation [°]")
        if not self.variances:
            axes.set_yticks([])
            axes.text(0.5, 0.5, f"no {self.window_size} angles without a gap:\nthis column is unchanged", ha="center",
                      transform=axes.transAxes)
            return
        share = 100 * np.maximum(self.variances, 0) / max(sum(self.variances), 1e-12)
        shown = min(len(share), MAX_COMPONENTS)
        for c, series in enumerate(self.elementary[:shown]):
            row = self.first_row + 0.5 + np.arange(len(series))
            axes.plot(row, 0.4 * series / max(np.abs(series).max(), 1e-12) - c, lw=1.5,
                      **({"color": "#0072B2"} if c < self.kept else {"color": "#888888", "ls": "--"}))
        axes.set_ylim(0.6 - shown, 0.6)
        axes.set_yticks(-np.arange(shown), [f"{c + 1}:  " + (f"{s:.1f} %" if s >= 0.05 else "< 0.1 %")
                                            for c, s in enumerate(share[:shown])])
        axes.set_ylabel("component: share of the variance")
        axes.grid(axis="y")

    def legend(self, axes, *more, **where):
        def mark(shape, colour):
            return Line2D([], [], ls="", marker=shape, color=colour, ms=7)
        handles = {"obstacles (RoI)": tuple(mark("s", colour) for colour in COLOURS),
                   "ground, far (ROU)": mark("s", ROU), "no return": mark("s", EMPTY),
                   "lone returns (RoI)": mark("s", LONE), "unclassified": mark("x", INK)}
        names = ["obstacles (RoI)", "ground, far (ROU)", *more]
        axes.legend([handles[name] for name in names], names, ncol=len(names), borderpad=0, handletextpad=0.5,
                    handler_map={tuple: HandlerTuple(ndivide=None, pad=0.1)}, **where)

    def top_view(self, page, box):
        axes = page.axes(*box)
        axes.set_xlim(self.half, -self.half)
        axes.set_ylim(-self.half, self.half)
        axes.grid()
        axes.add_patch(Circle((0, 0), self.zone_m, fill=False, ec="#888888", ls="--"))
        axes.set_xlabel("to the left [m]")
        axes.set_ylabel("forward [m]")
        x, y, label, component = (values[self.shown] for values in (self.x_m, self.y_m, self.label, self.component))
        axes.plot(y[label == 1], x[label == 1], "o", ms=1.8, mew=0, color=ROU)
        colour = self.colour[component]
        for c, name in [(len(COLOURS), LONE), *enumerate(COLOURS)]:
            some = (label == 2) & (colour == c)
            axes.plot(y[some], x[some], "o", ms=2 if name == LONE else 3, mew=0, color=name)
        axes.plot(y[label == 0], x[label == 0], "x", ms=4, color=INK)
        axes.plot(0, 0, "x", ms=10, mew=2.5, color="black")
        more = [name for name, some in (("lone returns (RoI)", (label == 2) & (component == 0)),
                                        ("unclassified", label == 0)) if some.any()]
        self.legend(axes, *more, loc="lower left", bbox_to_anchor=(0, 1))
        some = np.flatnonzero(label == 2)
        some = some[::1 + len(some) // 2000]  # enough to find room for labels
        self.label_obstacles(axes, x[some], y[some])

    def label_obstacles(self, axes, x, y):
        """Writes distances and heights of the nearest obstacles where they hide little."""
        returns = axes.transData.transform(np.column_stack([y, x]))
        frame, centre = axes.get_window_extent(), axes.transData.transform((0, 0))
        labelled = sorted({1, *self.large} & set(range(1, len(self.boxes) + 1)))[:LABELLED]
        points = {number: self.nearest_point(number)[::-1] for number in labelled}
        tips = {number: axes.transData.transform(at) for number, at in points.items()}
        taken = [(*(at - size), *(at + size)) for at, size in [(centre, 12), *((tip, 6) for tip in tips.values())]]
        lines = np.empty((0, 2))
        for number, at in points.items():
            distance, height = self.boxes[number - 1, :2]
            text = f"{distance:.1f} m" + (f", {height:.1f} m high" if height >= 0.05 else "")  # several beams
            tip, size, best = tips[number], np.array([6.9 * len(text), 19]), None
            for reach in (24, 50, 100, 170):
                for turn in np.arange(0, 2 * np.pi, np.pi / 6):
                    middle = tip + (reach + [0.45, 0] * size) * (np.cos(turn), np.sin(turn))
                    low, high = middle - size / 2, middle + size / 2
                    if (low < frame.p0 + 4).any() or (high > frame.p1 - 4).any():
                        continue
                    if any((low < t[2:]).all() and (high > t[:2]).all() for t in taken):
                        continue
                    line = tip + np.linspace(0, 1, 20)[:, None] * (middle - tip)
                    crossed = sum(((line > t[:2]) & (line < t[2:])).all(1).any() for t in taken) - 1  # own tip
                    crossed += ((lines > low) & (lines < high)).all(1).any()
                    cost = ((returns > low) & (returns < high)).all(1).sum() + reach / 2 + 100 * crossed
                    if best is None or cost < best[0]:
                        best = (cost, low, high, line)
            if best is None:
                continue
            taken.append((*best[1], *best[2]))
            lines = np.concatenate([lines, best[3]])
            axes.annotate(text, at, (best[1] + best[2]) / 2, textcoords="figure pixels", ha="center", va="center",
                          bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": COLOURS[self.colour[number]]},
                          arrowprops={"arrowstyle": "-", "lw": 0.8, "color": INK, "shrinkA": 0})
            axes.plot(*at, "o", ms=7, mew=1.5, mfc="white", color=INK)

    def nearest_point(self, number):
        own = np.flatnonzero(self.component == number)
        at = own[np.argmin(np.hypot(self.x_m[own], self.y_m[own]))]
        return self.x_m[at], self.y_m[at]

    def summary(self):
        if not len(self.boxes):
            return ""
        azimuth = round(np.degrees(np.arctan2(*self.nearest_point(1)[::-1])))
        where = f"{abs(azimuth)}° to the {'left' if azimuth > 0 else 'right'}" if azimuth else "straight ahead"
        return f"the nearest is {self.boxes[0, 0]:.1f} m away, {where}"


WIDE = (84, 1095)


def overview(scan):
    page = Page(1400, 850)
    page.heading(f"Obstacles within {scan.zone_m:g} m", scan.summary(), scan.title)
    scan.top_view(page, (64, 784, 52, 772))
    rows = [(880, 1316, top - 74, top) for top in range(772, 0, -124)]
    few = {"has_azimuth": False, "beams": 4}
    scan.distances(page, rows[0], scan.depth_m, "Distance image", rows[2][2], **few)
    scan.maxima_image(page, rows[1], "Persistent maxima", **few)
    scan.distances(page, rows[2], scan.merged_m, "After sharpening", **few)
    scan.angles(page, rows[3], scan.angle_rad, "Range angle", rows[4][2], **few)
    scan.angles(page, rows[4], scan.smoothed_rad, "Smoothed by SSA", **few)
    scan.label_panel(page, rows[5], "Labels", beams=4)
    return page


def depth(scan):
    page = Page(1200, 330)
    page.heading("1  Distance image", "paper: III-A", scan.title)
    scan.distances(page, (*WIDE, 60, 280), scan.depth_m, bar_bottom=60)
    return page


def maxima(scan):
    page = Page(1200, 860)
    page.heading("2  Persistent maxima", "of proximity; paper: III-B", scan.title)
    scan.maxima_image(page, (*WIDE, 590, 810), bar_bottom=590)
    scan.barcode(page, (*WIDE, 60, 490))
    return page


def merged(scan):
    page = Page(1200, 660)
    page.heading("3  After sharpening", "maxima sharpened and merged; paper: III-B", scan.title)
    scan.distances(page, (*WIDE, 390, 610), scan.merged_m, bar_bottom=390)
    where = f"Around the column at {scan.azimuth:.1f}°, "
    scan.distances(page, (84, 570, 60, 280), scan.repaired_m, where + "before", is_zoomed=True)
    scan.distances(page, (650, 1136, 60, 280), scan.merged_m, "after", is_zoomed=True)
    return page


def range_angle(scan):
    page = Page(1200, 330)
    page.heading("4  Range angle", "paper: III-C", scan.title)
    scan.angles(page, (*WIDE, 60, 280), scan.angle_rad, bar_bottom=60)
    return page


def smoothed(scan):
    page = Page(1200, 860)
    page.heading("5  Smoothed by SSA", "singular spectrum analysis; paper: III-D", scan.title)
    scan.angles(page, (*WIDE, 590, 800), scan.smoothed_rad, bar_bottom=590, has_mark=True)
    scan.series(page, (84, 560, 60, 480))
    scan.principal_components(page, (760, 1170, 60, 480))
    return page


def labels(scan):
    page = Page(1200, 660)
    page.heading("6  Labels", "regions of interest and uninterest; paper: III-E", scan.title)
    axes = scan.label_panel(page, (*WIDE, 390, 590))
    scan.legend(axes, "no return", loc="lower right", bbox_to_anchor=(1, 1))
    scan.label_panel(page, (*WIDE, 60, 280), f"Around the column at {scan.azimuth:.1f}°", is_zoomed=True)
    return page


def top_view(scan):
    page = Page(900, 960)
    page.heading(f"Obstacles within {scan.zone_m:g} m", "from above", scan.title)
    scan.top_view(page, (70, 880, 60, 870))
    return page


def stages(job):
    """The pictures of a scan, in `folder`."""
    scan = Scan(job)
    for name, picture in (("overview", overview), ("1_depth", depth), ("2_maxima", maxima), ("3_merged", merged),
                          ("4_range_angle", range_angle), ("5_smoothed", smoothed), ("6_labels", labels),
                          ("7_top_view", top_view)):
        picture(scan).save(os.path.join(scan.folder, name + ".png"))


def airframe(job):
    """`bin_range_m`: masked range by azimuth and elevation."""
    bins = job["bin_range_m"].T
    page = Page(1000, 530)
    axes = page.axes(70, 900, 70, 485, plain(job["title"]))
    axes.set_facecolor(EMPTY)
    drawn = axes.imshow(np.where(bins > 0, bins, np.nan), origin="lower", extent=(-180, 180, -90, 90), vmin=0,
                        vmax=max(bins.max(), 0.1), interpolation="nearest", zorder=2)
    axes.set_xlim(180, -180)
    axes.set_xticks(range(-180, 181, 45))
    axes.set_yticks(range(-90, 91, 30))
    axes.grid(color="#CCCCCC")
    axes.set_xlabel(AZIMUTH)
    axes.set_ylabel("elevation [°]")
    page.colour_bar(drawn, "masked up to [m]", (912, 930, 70, 485))
    page.save(job["file"])


def chart(job):
    """`panels` with `lines`: x, y, intervals `low`, `high`, and a point to `mark`, in `columns`. Scores end at 1."""
    panels, width, height = job["panels"], job["width"], job["height"]
    columns, page = job.get("columns", len(panels)), Page(width, height)
    rows = -(-len(panels) // columns)
    has_legend = any(len(panel["lines"]) > 1 for panel in panels)
    right = width - (200 if has_legend else 20)
    below = 130 if any(len(panel.get("categories", [])) > 8 for panel in panels) else 62
    y = np.array([v for panel in panels for line in panel["lines"] for v in line["y"]], float)
    lowest = min(0.8, np.floor(10 * np.nanmin(y, initial=1)) / 10)
    for p, panel in enumerate(panels):
        row, column = divmod(p, columns)
        top = height * (rows - row) // rows
        axes = page.axes(75 + right * column / columns, right * (column + 1) / columns, top - height // rows + below,
                         top - 40, plain(panel["title"]))
        axes.set_xlabel(plain(panel.get("x", "")))
        axes.set_ylabel(panel["y"])
        axes.grid(axis=panel.get("grid", "y"))
        for l, line in enumerate(panel["lines"]):
            x, y = np.array(line["x"], float), np.array(line["y"], float)
            low, high = (np.array(line.get(end, line["y"]), float) for end in ("low", "high"))
            if "categories" in panel:  # so that intervals do not overlap
                x += 0.08 * (l - (len(panel["lines"]) - 1) / 2)
            intervals = [np.maximum(y - low, 0), np.maximum(high - y, 0)] if line.keys() & {"low", "high"} else None
            marker = "os^vDPX"[l % 7] if len(x) < 50 or panel.get("ls") == "" else ""
            axes.errorbar(x, y, intervals, fmt=marker, ls=panel.get("ls", "-"), lw=1.3,
                          ms=3.5 if len(x) < 50 else 2.5, elinewidth=0.7, color=CHART_COLOURS[l % 7], label=plain(line["name"]))
            if "mark" in line:
                axes.plot(*line["mark"], "o", ms=10, mfc="none", color=CHART_COLOURS[l % 7])
        log = panel.get("log", "")
        for name, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
            if name in log:
                getattr(axes, f"set_{name}scale")("log")
                axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
                axis.set_major_formatter(lambda value, _: f"{value:g}")
                axis.set_minor_formatter(NullFormatter())
        if "y" not in log:
            axes.set_ylim(lowest, 1.02 - 0.02 * lowest)  # shows whole marks at 1
        if "categories" in panel:
            axes.set_xticks(range(len(panel["categories"])), map(plain, panel["categories"]))
            axes.set_xlim(-0.5, len(panel["categories"]) - 0.5)
        if "ticks" in panel:
            limits = axes.get_xlim()
            axes.set_xticks(panel["ticks"], panel.get("tick_names"))
            axes.set_xticks([], minor=True)
            axes.set_xlim(limits)
        if below > 100:
            axes.tick_params("x", rotation=60)
        if has_legend and column + 1 == columns:
            axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02))
    page.save(job["file"])


def main():
    matplotlib.rcdefaults()  # not the user's settings
    matplotlib.rcParams.update({
        "font.size": 9.5, "axes.edgecolor": INK, "axes.titlesize": 10, "axes.titleweight": "bold",
        "axes.titlelocation": "left", "axes.axisbelow": True, "axes.unicode_minus": False, "grid.color": LINES,
        "legend.frameon": False, "svg.fonttype": "none", "svg.hashsalt": "hagen"})
    jobs = sys.stdin.buffer
    for line in iter(jobs.readline, b""):
        job = json.loads(line)
        for name, (kind, shape) in job.pop("arrays", {}).items():
            values = np.dtype(f"<{kind}")
            job[name] = np.frombuffer(jobs.read(int(np.prod(shape)) * values.itemsize), values).reshape(shape)
        try:
            {"stages": stages, "airframe": airframe, "chart": chart}[job["kind"]](job)
            print(flush=True)
        except RuntimeError as error:
            print(plain(str(error), 1000), flush=True)


main()
