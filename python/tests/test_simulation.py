"""hagen.simulate() and hagen.evaluate() match rawlog-simulate and segmentation-evaluate."""
import json
import math

import numpy as np
import pytest

import hagen


@pytest.fixture(scope="module")
def flight(program, tmp_path_factory):
    """A flight written by rawlog-simulate."""
    folder = tmp_path_factory.mktemp("flight") / "scans"
    program(
        "rawlog-simulate", "--scenario", "orchard", "--scans", 3, "--seed", 5, "--altitude", 3,
        "--kitti", folder, "-q",
    )  # fmt: skip
    return folder


def simulated():
    return list(hagen.simulate("orchard", 3, 5, altitude_m=3))


def test_scans_match_program(flight):
    scans = simulated()
    assert len(scans) == 3
    for number, scan in enumerate(scans):
        points = np.fromfile(flight / "velodyne" / f"{number:06}.bin", np.float32).reshape(-1, 4)
        truth = np.fromfile(flight / "labels" / f"{number:06}.label", np.uint32)
        kind = np.fromfile(flight / "semantic" / f"{number:06}.label", np.uint32)
        np.testing.assert_array_equal(scan.xyz, points[:, :3])
        np.testing.assert_array_equal(scan.truth, truth & 0xFFFF)
        np.testing.assert_array_equal(scan.object, truth >> 16)
        np.testing.assert_array_equal(scan.kind, kind & 0xFFFF)
        assert scan.truth.dtype == scan.kind.dtype == np.uint8 and scan.object.dtype == np.uint16
    altitudes = np.loadtxt(flight / "altitudes.txt")
    np.testing.assert_allclose([scan.altitude_m for scan in scans], altitudes, atol=1e-3)
    times = np.loadtxt(flight / "times.txt")
    np.testing.assert_allclose([scan.time for scan in scans], times, atol=1e-6)
    poses = np.loadtxt(flight / "poses.tum")
    np.testing.assert_allclose([scan.pose[:3, 3] for scan in scans], poses[:, 1:4], atol=1e-6)


def test_scores_match_program(program, flight, tmp_path):
    program("segmentation-evaluate", "-i", flight, "-c", "vlp16", "--json", tmp_path / "scores.json")
    expected = json.loads((tmp_path / "scores.json").read_text())

    segmenter = hagen.Filter("vlp16")
    total = hagen.Scores()
    for scan in simulated():
        # Scan folders contain points and poses, but no packets.
        labels = segmenter.segment(scan.xyz, attitude=scan.attitude).labels
        total += hagen.evaluate(labels, scan.truth, scan.xyz)
    method = find_f1(expected)
    assert total.roi.f1 == pytest.approx(method[0], abs=2e-4)
    assert total.rou.f1 == pytest.approx(method[1], abs=2e-4)
    assert 0.9 < total.roi.f1 < 1


def find_f1(summary):
    """The F1 of RoI and ROU of the first method in a summary of segmentation-evaluate."""
    returns = summary["methods"][0]["returns"]["all"]
    return returns["roi"]["f1"], returns["rou"]["f1"]


def test_scores_count_labels():
    truth = np.array([2, 2, 2, 1, 1, 0], np.uint8)
    found = np.array([2, 1, 0, 1, 2, 2], np.uint8)
    scores = hagen.evaluate(found, truth)
    assert (scores.roi.hits, scores.roi.misses, scores.roi.false_alarms) == (1, 2, 1)
    assert (scores.rou.hits, scores.rou.misses, scores.rou.false_alarms) == (1, 1, 1)
    assert scores.roi.precision == pytest.approx(1 / 2)
    assert scores.roi.recall == pytest.approx(1 / 3)
    assert scores.roi.f1 == pytest.approx(2 / 5)
    assert scores.returns == 5 and scores.correct == pytest.approx(2 / 5)
    twice = scores + scores
    assert twice.roi.hits == 2 and scores.roi.hits == 1
    assert math.isnan(hagen.Scores().roi.f1)
    same = twice
    same += scores
    assert same is twice and twice.roi.hits == 3 and scores.roi.hits == 1


def test_scores_ignore_farther_returns():
    xyz = np.array([[19.9, 0, 0], [0, 20.1, 0], [0, 0, 5]])
    scores = hagen.evaluate([2, 1, 2], [2, 2, 2], xyz)
    assert scores.returns == 2 and scores.correct == 1
    assert hagen.evaluate([2, 1, 2], [2, 2, 2], xyz, max_range_m=21).returns == 3


@pytest.mark.parametrize("max_range_m", [math.inf, -math.inf, math.nan, 1e300, 1e30, 1001, 0.05, -1])
def test_rejects_ranges_beyond_limits(max_range_m):
    with pytest.raises(ValueError, match="max_range_m: .* is not between 0.1 and 1000.0"):
        hagen.evaluate([1, 2], [1, 2], np.ones((2, 3)), max_range_m=max_range_m)
    for limit_m in (0.1, 1000):
        assert hagen.evaluate([1], [1], np.full((1, 3), 0.05), max_range_m=limit_m).returns == 1


@pytest.mark.parametrize("sensor, rows", [("HDL-64E", 64), ("Mid-360", 24), ("Avia", 40), ("HAP", 16)])
def test_simulates_other_sensors(sensor, rows):
    scan = next(hagen.simulate("forest-0.05", seed=2, sensor=sensor))
    assert scan.sensor == sensor
    assert (scan.ring is None) == (sensor != "HDL-64E")
    result = hagen.Filter(sensor.lower().replace("-", "")).segment(scan)
    assert result.stages["depth_m"].shape[0] == rows
    assert hagen.evaluate(result.labels, scan.truth, scan.xyz).roi.f1 > 0.8


def test_clear_air_has_no_dust():
    dust, airframe = 10, 11
    kinds = {clear: set(next(hagen.simulate("field", clear_air=clear)).kind) for clear in (0, 1)}
    assert not {dust, airframe} & kinds[True]
    assert {dust, airframe} & kinds[False]


def test_rejects_wrong_flight_arguments():
    with pytest.raises(ValueError, match="jungle.*orchard"):
        hagen.simulate("jungle")
    with pytest.raises(ValueError, match="sensor|VLP-16"):
        hagen.simulate("orchard", sensor="OS1-64")
    with pytest.raises(ValueError, match="altitude_m: 0.5 is not between 1.0 and 15.0"):
        hagen.simulate("orchard", altitude_m=0.5)
    with pytest.raises(ValueError, match="scans: 0.0"):
        hagen.simulate("orchard", 0)
    with pytest.raises(TypeError):
        hagen.simulate("orchard", seed=-1)
    assert "orchard" in hagen.scenarios()


@pytest.mark.parametrize(
    "labels, truth, xyz, text",
    [
        ([1, 2], [1], None, r"labels \(2\) and true labels \(1\) differ"),
        ([1, 3], [1, 2], None, "labels.*not 3 at 1"),
        ([1, 2], [1, -1], None, "truth.*not -1 at 1"),
        ([1, 1.5], [1, 1], None, "not 1.5 at 1"),
        ([[1, 2]], [1, 2], None, r"labels.*not of shape \(1, 2\)"),
        (["RoI"], [2], None, "labels.*dtype <U3"),
        ([1, 2], [1, 2], np.zeros((3, 3)), r"labels \(2\) and points \(3\) differ"),
    ],
)
def test_rejects_wrong_labels(labels, truth, xyz, text):
    with pytest.raises(ValueError, match=text):
        hagen.evaluate(labels, truth, xyz)
