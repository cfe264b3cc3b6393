"""Regions of interest in sparse LiDAR scans, without a map.

    import hagen

    filter = hagen.Filter("vlp16")
    for scan in hagen.open("flight.pcap"):
        result = filter.segment(scan)
        obstacles = scan.xyz[result.labels == hagen.ROI]

See docs/python.md.
"""
import pathlib as _pathlib

from . import _hagen
from ._hagen import (
    ROI,
    ROU,
    UNCLASSIFIED,
    ClassScore,
    Filter,
    Recording,
    Result,
    Scan,
    Scores,
    SettingsError,
    Simulation,
    __version__,
    evaluate,
    presets,
    scenarios,
)

__all__ = [
    "ROI",
    "ROU",
    "UNCLASSIFIED",
    "ClassScore",
    "Filter",
    "Recording",
    "Result",
    "Scan",
    "Scores",
    "SettingsError",
    "Simulation",
    "__version__",
    "evaluate",
    "open",
    "presets",
    "scenarios",
    "simulate",
]

# Makes the presets of this package available.
_hagen._add_presets(_pathlib.Path(_hagen.__file__).parent / "config")


def _several(names):
    """Returns a list of names; a str is a single name."""
    return [names] if isinstance(names, str) else list(names)


def open(
    file,
    *,
    sensor_labels=(),
    poses="",
    sensor_json="",
    calibration="",
    topics=(),
    first=0,
    last=None,
):
    """Opens a recording and returns an iterator of its scans (Scan).

    file: a rawlog, a capture (.pcap, .pcapng), a ROS recording (.bag, .mcap, .db3 or its folder), a
        scan folder, or a point cloud (.pcd, .ply, .las, .npy, .bin) or a folder of them. The
        content determines the format.
    sensor_labels: labels of the LiDARs to read (default: all). After the last scan,
        Recording.remarks lists labels without scans.
    poses: a pose file (TUM, KITTI; default: the poses of the recording).
    sensor_json: Ouster metadata for a capture or bag.
    calibration: HDL-64E calibration for a capture (db.xml).
    topics: LiDAR topics of a bag to read (default: all).
    first, last: the range of entries to read, both inclusive.

    Raises FileNotFoundError, or RuntimeError naming the file (and the entry, while iterating) if it
    cannot be read.
    """
    return Recording(
        file,
        sensor_labels=_several(sensor_labels),
        poses=poses,
        sensor_json=sensor_json,
        calibration=calibration,
        topics=_several(topics),
        first=first,
        last=last,
    )


def simulate(
    scenario,
    scans=1,
    seed=1,
    *,
    altitude_m=2.0,
    sensor="VLP-16",
    speed_m_s=4.0,
    tilt_sd_deg=4.0,
    every_s=0.1,
    clear_air=False,
):
    """Simulates a LiDAR flight over a scene; returns an iterator of scans with Scan.truth.

    The scans equal those of rawlog-simulate for the same arguments.

    scenario: the scene, one of scenarios().
    scans: number of scans.
    seed: the same seed produces the same scene, flight and scans.
    altitude_m: height above the ground, 0.2 to 15.
    sensor: 'VLP-16', 'HDL-32E', 'HDL-64E', 'Mid-360', 'Avia' or 'HAP'.
    speed_m_s: speed on straights, 0.1 to 20.
    tilt_sd_deg: standard deviation of roll and of pitch, 0 (level flight) to 15.
    every_s: time between the starts of scans, at least 0.1.
    clear_air: whether to omit dust and returns from the vehicle itself.

    Raises ValueError for an unknown scenario or sensor, and for numbers out of range.
    """
    return Simulation(
        scenario,
        scans,
        seed,
        altitude_m=altitude_m,
        sensor=sensor,
        speed_m_s=speed_m_s,
        tilt_sd_deg=tilt_sd_deg,
        every_s=every_s,
        clear_air=clear_air,
    )
