#!/usr/bin/env python3
"""Draws the obstacles of a scan from above, one colour each, and the ground in grey.

usage: plot_obstacles.py RECORDING [FOLDER]     without a folder, in a window
"""
import itertools
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

import hagen


def draw(recording, folder=None):
    # The largest of three scans: the first turn of a capture may be incomplete.
    scan = max(itertools.islice(hagen.open(recording), 3), key=len, default=None)
    if scan is None:
        raise RuntimeError(f"{recording}: has no LiDAR scan")
    result = hagen.Filter("vlp16").segment(scan)

    x, y, _ = scan.xyz.T
    ground = result.labels == hagen.ROU
    near = result.obstacles > 0
    sizes = np.bincount(result.obstacles[near])
    shown_m = np.clip(1.2 * np.abs(scan.xyz[near, :2]).max(initial=0), 5, 25)  # from a room to the zone
    figure, axes = plt.subplots(figsize=(8, 8), layout="constrained")
    axes.scatter(y[ground], x[ground], s=1, color="0.8")
    colours = np.delete(plt.get_cmap("tab20").colors, [14, 15], axis=0)  # its greys look like ground
    axes.scatter(y[near], x[near], s=3, c=colours[result.obstacles[near] % len(colours)])
    axes.plot(0, 0, "k+")
    axes.set(
        xlim=(shown_m, -shown_m), ylim=(-shown_m, shown_m), aspect="equal", xlabel="left [m]", ylabel="forward [m]",
        title=f"{np.count_nonzero(sizes >= 30)} obstacles of 30 returns or more within 20 m",
    )  # fmt: skip
    if folder is None:
        if plt.get_backend().lower() == "agg":
            raise RuntimeError("no display available; pass a FOLDER for the picture")
        plt.show()
    else:
        pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
        figure.savefig(pathlib.Path(folder) / "obstacles.png", dpi=120)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    try:
        draw(*sys.argv[1:])
    except (OSError, RuntimeError) as error:
        sys.exit(str(error))
