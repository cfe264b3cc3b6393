#!/usr/bin/env python3
"""Walks through the stages of the filter on one scan. Cells begin with # %% for editors
that support them; run as a program, it draws all of them.

usage: walk_through.py RECORDING [FOLDER]     without a folder, in windows
"""
# %% A scan and the filter for its sensor.
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

import hagen

if not 2 <= len(sys.argv) <= 3:
    sys.exit(__doc__)
if len(sys.argv) == 2 and plt.get_backend().lower() == "agg":
    sys.exit("no display available; pass a FOLDER for the pictures")
try:
    scan = next(hagen.open(sys.argv[1]))
except (OSError, RuntimeError) as error:
    sys.exit(str(error))
except StopIteration:
    sys.exit(f"{sys.argv[1]}: has no LiDAR scan")
result = hagen.Filter("vlp16").segment(scan)
stages = result.stages
print(scan, result)


def show(name, figure):
    if len(sys.argv) == 3:
        pathlib.Path(sys.argv[2]).mkdir(parents=True, exist_ok=True)
        figure.savefig(pathlib.Path(sys.argv[2]) / f"{name}.png", dpi=120)
    else:
        plt.show()


def draw(axes, name, title, scale=1.0, **options):
    # Row 0 is the lowest beam; column 0 looks backwards, the middle one ahead.
    layout = {"origin": "lower", "aspect": "auto", "interpolation": "none"}
    image = axes.imshow(scale * stages[name], **layout, **options)
    axes.set_title(title, loc="left")
    axes.figure.colorbar(image, ax=axes, pad=0.01)


# %% From depth to angles: proximity is bright for near pixels, and its maxima are moved nearer.
figure, axes = plt.subplots(5, figsize=(12, 10), layout="constrained", sharex=True)
draw(axes[0], "depth_m", "1: depth [m]", vmax=40)
draw(axes[1], "proximity_m", "3: proximity, zone - depth [m]")
draw(axes[2], "merged_m", "5: depth with sharpened maxima [m]", vmax=40)
draw(axes[3], "range_angle_rad", "6: angle from each beam to the one above [deg]", np.degrees(1))
draw(axes[4], "smoothed_rad", "7: the same, smoothed along columns [deg]", np.degrees(1))
show("1_angles", figure)

# %% From angles to labels: flat regions from the lowest pixels are ground; all above is RoI.
figure, axes = plt.subplots(4, figsize=(12, 8), layout="constrained", sharex=True)
draw(axes[0], "pixel_angle_rad", "8: the angle of each pixel [deg]", np.degrees(1))
if "height_m" in stages:
    draw(axes[1], "height_m", "height above the ground surface [m]", vmin=-0.5, vmax=3)
    draw(axes[2], "tolerance_m", "maximum height of ground [m]", vmin=0, vmax=0.5)
draw(axes[3], "labels", "labels: 0 unclassified, 1 ROU, 2 RoI", vmin=0, vmax=2)
show("2_labels", figure)

# %% The labels of the returns: height and obstacle.
figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
distance = np.linalg.norm(scan.xyz, axis=1)
for label, color, name in ((hagen.ROU, "0.7", "ROU"), (hagen.ROI, "tab:red", "RoI")):
    chosen = result.labels == label
    axes.scatter(distance[chosen], result.heights[chosen], s=1, color=color, label=name)
axes.set(xlim=(0, 25), ylim=(-1, 6), xlabel="range [m]", ylabel="height above the ground [m]")
axes.legend()
show("3_heights", figure)
