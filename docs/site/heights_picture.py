"""Draws a slice of a scan from the side, with the ground surface from which heights are measured.

Usage: heights_picture.py RECORDING AZIMUTH_DEG PICTURE.png     draws the first scan; azimuths are counter-clockwise from x
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import hagen  # noqa: E402

HALF_WIDTH_DEG = 3


def main():
    recording, azimuth_deg, picture = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    scan = next(iter(hagen.open(recording)))
    result = hagen.Filter("vlp16").segment(scan)

    to_ground = result.ground
    over_plane = scan.xyz @ to_ground[:3, :3].T + to_ground[:3, 3]
    distance_m = np.hypot(over_plane[:, 0], over_plane[:, 1])
    beside_deg = np.degrees(np.arctan2(scan.xyz[:, 1], scan.xyz[:, 0])) - azimuth_deg
    shown = np.abs((beside_deg + 180) % 360 - 180) < HALF_WIDTH_DEG
    shown &= (distance_m < 21) & np.isfinite(result.heights)
    distance_m, height_m = distance_m[shown], result.heights[shown]
    over_plane, labels = over_plane[shown], result.labels[shown]

    figure, axes = plt.subplots(figsize=(9, 3.4), layout="constrained")
    order = np.argsort(distance_m)
    surface_m = over_plane[order, 2] - height_m[order]
    axes.plot(distance_m[order], surface_m, color="#666666", lw=1, label="ground surface")
    for label, color, name in ((hagen.ROU, "#a9b9cc", "ROU"), (hagen.ROI, "#d55e00", "RoI")):
        of = labels == label
        axes.scatter(distance_m[of], over_plane[of, 2], s=7, color=color, label=name)
    axes.plot(0, to_ground[2, 3], "kx", label="sensor")
    axes.set(xlabel="distance [m]", ylabel="height above the ground plane [m]", aspect="equal", ylim=(-1, 4.5), xlim=(-0.5, 21))
    axes.set_title(f"returns within {HALF_WIDTH_DEG} degrees of azimuth {azimuth_deg:g}", loc="left", fontsize=10)
    axes.grid(alpha=0.3)
    axes.legend(ncols=4, fontsize=8, loc="lower right", bbox_to_anchor=(1, 1), frameon=False)
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    main()
