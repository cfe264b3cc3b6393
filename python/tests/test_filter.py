"""hagen.Filter on arrays, compared with rawlog-segment on the same points, and with geometry."""
import sys
import threading
import warnings

import numpy as np
import pytest

import hagen


def ground_and_pillar(height_m=1.5):
    """A VLP-16 over flat ground, with a pillar 8 m away at 0.5 rad. Returns points, and a mask of
    the pillar."""
    elevations = np.radians(np.arange(-15, 16, 2))
    azimuth, elevation = (
        grid.ravel() for grid in np.meshgrid(np.radians(np.arange(0, 360, 0.4)), elevations)
    )
    with np.errstate(divide="ignore"):
        ground = np.where(elevation < 0, height_m / np.tan(-elevation), np.inf)
    is_pillar = (np.abs(azimuth - 0.5) < 0.02) & (ground > 8)
    horizontal = np.where(is_pillar, 8.0, ground)
    seen = horizontal < 100
    points = np.stack(
        [
            horizontal[seen] * np.cos(azimuth[seen]),
            horizontal[seen] * np.sin(azimuth[seen]),
            horizontal[seen] * np.tan(elevation[seen]),
        ],
        axis=1,
    ).astype(np.float32)
    return points, is_pillar[seen]


def test_labels_ground_and_pillar():
    points, is_pillar = ground_and_pillar()
    result = hagen.Filter("vlp16").segment(points)

    assert result.labels.shape == (len(points),) and result.labels.dtype == np.uint8
    assert result.obstacles.shape == (len(points),) and result.obstacles.dtype == np.int32
    above = points[:, 2] > -1.2
    assert np.all(result.labels[is_pillar & above] == hagen.ROI)
    assert np.all(result.labels[~is_pillar] == hagen.ROU)
    assert np.all(result.obstacles[is_pillar & above] == 1)
    assert np.all(result.obstacles[result.labels == hagen.ROU] == 0)
    assert len(result) == len(points)


def test_heights_are_above_the_ground():
    points, _ = ground_and_pillar(1.5)
    near = np.linalg.norm(points, axis=1) < 20
    result = hagen.Filter("vlp16").segment(points)
    assert result.heights.dtype == np.float32
    np.testing.assert_allclose(result.heights[near], points[near, 2] + 1.5, atol=0.1)
    on_ground = near & (points[:, 2] < -1.49)
    np.testing.assert_allclose(np.median(np.abs(result.heights[on_ground])), 0, atol=1e-3)
    np.testing.assert_allclose(result.ground[2, 3], 1.5, atol=0.02)


def test_labels_match_program(program, poles_labels, tmp_path):
    """Points of a scan folder, without packets, poses or tilt."""
    folder = tmp_path / "scans"
    (folder / "velodyne").mkdir(parents=True)
    for file in (poles_labels / "velodyne").iterdir():
        (folder / "velodyne" / file.name).write_bytes(file.read_bytes())
    program("rawlog-segment", "-i", folder, "--kitti", tmp_path / "labels", "-c", "vlp16", "-q")

    segmenter = hagen.Filter("vlp16")
    files = sorted((folder / "velodyne").iterdir())
    assert len(files) == 10
    for file in files:
        points = np.fromfile(file, np.float32).reshape(-1, 4)
        expected = np.fromfile(tmp_path / "labels" / "labels" / f"{file.stem}.label", np.uint32)
        result = segmenter.segment(points[:, :3])
        np.testing.assert_array_equal(result.labels, expected & 0xFFFF)
        np.testing.assert_array_equal(result.obstacles, expected >> 16)
        assert np.count_nonzero(result.labels == hagen.ROI) > 1000


def test_warns_of_suspicious_results():
    points, _ = ground_and_pillar()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        hagen.Filter("vlp16").segment(points)
    upside_down = hagen.Filter("vlp16")
    with pytest.warns(UserWarning, match="no ground .* --set sensor.mount_roll_deg=180"):
        upside_down.segment(points * np.float32([1, -1, -1]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # each kind once
        upside_down.segment(points * np.float32([1, -1, -1]))


@pytest.mark.parametrize(
    "convert",
    [
        lambda points: points.astype(np.float64),
        np.asfortranarray,
        lambda points: np.hstack([points, points])[:, :3],
        lambda points: np.repeat(points, 2, axis=0)[::2],
        lambda points: points.astype(">f4"),
        lambda points: points.tolist(),
    ],
    ids=["double", "fortran", "columns", "rows", "big-endian", "lists"],
)
def test_layouts_and_types_are_equivalent(convert):
    points, _ = ground_and_pillar()
    segmenter = hagen.Filter("vlp16")
    expected = segmenter.segment(points).labels.copy()
    np.testing.assert_array_equal(segmenter.segment(convert(points)).labels, expected)


def test_stages_have_image_shape():
    points, is_pillar = ground_and_pillar()
    result = hagen.Filter("vlp16").segment(points)
    stages = result.stages
    assert list(stages) == [
        "depth_m",
        "repaired_m",
        "proximity_m",
        "sharpened_m",
        "merged_m",
        "range_angle_rad",
        "smoothed_rad",
        "pixel_angle_rad",
        "labels",
        "components",
        "height_m",
        "tolerance_m",
    ]
    for name, image in stages.items():
        assert image.shape == ((15 if name in ("range_angle_rad", "smoothed_rad") else 16), 870)
    assert stages["labels"].dtype == np.uint8 and stages["components"].dtype == np.int32
    assert stages["depth_m"].dtype == np.float32

    # Column 0 points backwards, columns run clockwise; row 0 is the lowest beam.
    column = round(870 / 2 - 0.5 / (2 * np.pi) * 870)
    assert stages["depth_m"][8, column] == pytest.approx(8 / np.cos(np.radians(1)), abs=0.01)
    assert stages["labels"][8, column] == hagen.ROI
    assert stages["depth_m"][0, 0] == pytest.approx(1.5 / np.sin(np.radians(15)), abs=0.01)
    np.testing.assert_array_equal(
        np.isnan(stages["proximity_m"]), np.isnan(stages["depth_m"])
    )


def test_paper_settings_find_no_ground():
    points, _ = ground_and_pillar()
    result = hagen.Filter("paper").segment(points)
    assert "height_m" not in result.stages
    assert result.ground is None
    assert np.all(np.isnan(result.heights))


def test_results_outlive_filter():
    points, _ = ground_and_pillar()
    segmenter = hagen.Filter("vlp16")
    first = segmenter.segment(points)
    labels, depth = first.labels, first.stages["depth_m"]
    kept_labels, kept_depth = labels.copy(), depth.copy()
    del first
    for _ in range(10):
        segmenter.segment(0.5 * points)
    del segmenter
    np.testing.assert_array_equal(labels, kept_labels)
    np.testing.assert_array_equal(depth, kept_depth)


def test_arrays_share_memory():
    points, _ = ground_and_pillar()
    result = hagen.Filter("vlp16").segment(points)
    assert np.shares_memory(result.labels, result.labels)
    assert np.shares_memory(result.stages["depth_m"], result.stages["depth_m"])


def test_attitude_levels_scan():
    """Without its attitude, an upside-down sensor mistakes the ground for obstacles."""
    points, is_pillar = ground_and_pillar()
    upside_down = points * np.array([1, -1, -1], np.float32)
    segmenter = hagen.Filter("vlp16")
    result = segmenter.segment(upside_down, attitude=(np.pi, 0))
    np.testing.assert_array_equal(result.labels, segmenter.segment(points).labels)
    without_attitude = segmenter.segment(upside_down)
    assert np.count_nonzero(without_attitude.labels == hagen.ROI) > 10 * np.count_nonzero(is_pillar)


def test_applies_options_and_settings_files(tmp_path):
    points, is_pillar = ground_and_pillar()
    settings = tmp_path / "near.yaml"
    settings.write_text("zone_m: 5\n")
    for segmenter in (hagen.Filter("vlp16", settings), hagen.Filter("vlp16", zone_m=5)):
        assert np.all(segmenter.segment(points).labels == hagen.ROU)
        assert "zone_m: 5 " in segmenter.settings
    assert "height_m" in hagen.Filter("vlp16").segment(points).stages
    assert "height_m" not in hagen.Filter("vlp16", ground_surface=False).segment(points).stages


def test_unnamed_sensor_is_recovered():
    scan = next(iter(hagen.simulate("orchard", seed=3, sensor="HDL-32E")))
    segmenter = hagen.Filter()
    found = segmenter.segment(scan.xyz).labels
    assert segmenter.sensor == "HDL-32E"
    assert len(segmenter.elevations_rad) == 32
    expected = hagen.Filter("hdl32e").segment(scan.xyz).labels
    assert np.mean(found == expected) > 0.99


def test_filter_releases_gil():
    points = np.random.default_rng(1).uniform(-30, 30, (2_000_000, 3)).astype(np.float32)
    segmenter = hagen.Filter("vlp16")
    ticks, is_done = [], threading.Event()

    def tick():
        while not is_done.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(60)  # threads switch only when the GIL is released
    try:
        thread.start()
        before = len(ticks)
        segmenter.segment(points)
        meanwhile = len(ticks) - before
    finally:
        sys.setswitchinterval(interval)
        is_done.set()
        thread.join()
    assert meanwhile >= 3


def test_filter_is_thread_safe():
    scans = [ground_and_pillar(height)[0] for height in (1.0, 1.5, 2.0, 2.5)]
    segmenter = hagen.Filter("vlp16")
    expected = [segmenter.segment(points).labels.copy() for points in scans]
    wrong = []

    def work(number):
        for _ in range(30):
            found = segmenter.segment(scans[number])
            if not np.array_equal(found.labels, expected[number]):
                wrong.append(number)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_accepts_empty_scans_and_points_without_range():
    segmenter = hagen.Filter("vlp16")
    empty = segmenter.segment(np.empty((0, 3), np.float32))
    assert empty.labels.shape == (0,) and empty.stages["depth_m"].shape == (16, 870)

    points, _ = ground_and_pillar()
    points[3] = np.nan
    points[5] = 0
    result = segmenter.segment(points)
    assert result.labels[3] == result.labels[5] == hagen.UNCLASSIFIED
    assert np.isnan(result.heights[3])
    assert np.count_nonzero(result.labels == hagen.UNCLASSIFIED) == 2


@pytest.mark.parametrize(
    "points, text",
    [
        (np.zeros((5, 4)), r"\(N, 3\).*not of shape \(5, 4\); pass points\[:, :3\]"),
        (np.zeros((3, 5)), r"\(N, 3\).*not of shape \(3, 5\)"),
        (np.zeros((5, 2)), r"\(N, 3\).*not of shape \(5, 2\)"),
        (np.zeros(3), r"\(N, 3\).*not of shape \(3,\)"),
        (np.zeros((2, 2, 3)), r"not of shape \(2, 2, 3\)"),
        (np.zeros((5, 3), complex), "complex128"),
        ("flight.pcap", "dtype <U11"),
        (None, "dtype object"),
        ([[1, 2], [3]], r"\(N, 3\)"),
    ],
)
def test_rejects_wrong_points(points, text):
    with pytest.raises(ValueError, match=text):
        hagen.Filter("vlp16").segment(points)


def test_rejects_masked_points():
    points = np.ma.array(np.ones((4, 3)), mask=False)
    assert len(hagen.Filter("vlp16").segment(points).labels) == 4
    points[2, 0] = np.ma.masked
    with pytest.raises(ValueError, match="masked entries"):
        hagen.Filter("vlp16").segment(points)
    with pytest.raises(ValueError, match="masked entries"):
        hagen.evaluate(np.ma.array([1, 2], mask=[0, 1]), [1, 2])


def test_rejects_float32_overflow():
    far = np.full((3, 3), 1e300)
    segmenter = hagen.Filter("vlp16")
    with np.errstate(all="raise"), pytest.raises(ValueError, match="float32 cannot hold") as raised:
        segmenter.segment(far)
    assert isinstance(raised.value.__cause__, FloatingPointError)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match="float32 cannot hold"):
            segmenter.segment(far)
    with np.errstate(all="ignore"):  # infinite, so the points have no range
        assert np.all(segmenter.segment(far).labels == hagen.UNCLASSIFIED)


@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit, MemoryError])
def test_propagates_interrupts_in_conversion(error):
    class Interrupted:
        def __array__(self, *_, **__):
            raise error

    with pytest.raises(error):
        hagen.Filter("vlp16").segment(Interrupted())
    with pytest.raises(error):
        hagen.evaluate(Interrupted(), [1])


def test_conversion_error_is_cause():
    class Wrong:
        def __array__(self, *_, **__):
            raise ZeroDivisionError

    with pytest.raises(ValueError, match=r"\(N, 3\).*Wrong") as raised:
        hagen.Filter("vlp16").segment(Wrong())
    assert isinstance(raised.value.__cause__, ZeroDivisionError)


@pytest.mark.parametrize(
    "attitude",
    [1.0, (1, 2, 3), "level", (np.nan, 0), (0, np.inf), (1e300, 0), (0, -1e39), (6.3, 0), (0, 90)],
)
def test_rejects_wrong_attitudes(attitude):
    with pytest.raises(ValueError, match=r"attitude: expected \(roll, pitch\) \[rad\].*\+-2 pi"):
        hagen.Filter("vlp16").segment(np.zeros((5, 3)), attitude=attitude)


@pytest.mark.parametrize("pose", [1.0, np.eye(3), "map", np.full((4, 4), np.nan)])
def test_rejects_wrong_poses(pose):
    with pytest.raises(ValueError, match="pose"):
        hagen.Filter("vlp16").segment(np.zeros((5, 3)), pose=pose)


def test_window_labels_older_scans():
    points, is_pillar = ground_and_pillar()
    segmenter = hagen.Filter("vlp16", window_scans=2, label_window=True)
    assert len(segmenter.segment(points, pose=np.eye(4))) == len(points)
    moved = np.eye(4)
    moved[0, 3] = 1
    result = segmenter.segment(points, pose=moved)
    np.testing.assert_allclose(result.xyz[:len(points)], points)
    np.testing.assert_allclose(result.xyz[len(points):], points - [1, 0, 0], atol=1e-4)
    assert np.mean(result.labels[len(points):][is_pillar] == hagen.ROI) > 0.9
    newest = hagen.Filter("vlp16", window_scans=2)
    newest.segment(points, pose=np.eye(4))
    assert len(newest.segment(points, pose=moved)) == len(points)


def test_accepts_full_turn():
    points, _ = ground_and_pillar()
    segmenter = hagen.Filter("vlp16")
    expected = segmenter.segment(points, attitude=(0, 0)).labels
    for turn_rad in (2 * np.pi, np.float32(-2 * np.pi)):
        found = segmenter.segment(points, attitude=(turn_rad, 0)).labels
        assert np.mean(found == expected) > 0.99


def test_rejects_wrong_settings(tmp_path):
    with pytest.raises(hagen.SettingsError, match="vlp17.*did you mean 'vlp16'"):
        hagen.Filter("vlp17")
    with pytest.raises(hagen.SettingsError, match="beta"):
        hagen.Filter("vlp16", beta=7)
    with pytest.raises(hagen.SettingsError, match="zone_m"):
        hagen.Filter("vlp16", zone_m="far")
    with pytest.raises(hagen.SettingsError, match="zone_m"):
        hagen.Filter("vlp16", zone_m="\ud800")
    with pytest.raises(hagen.SettingsError, match="zone"):
        hagen.Filter("vlp16", **{"zone\ud800": 1})
    broken = tmp_path / "broken.yaml"
    broken.write_text("zone: 5\n")
    with pytest.raises(hagen.SettingsError, match="broken.yaml.*zone"):
        hagen.Filter(broken)
    with pytest.raises(TypeError):
        hagen.Filter(5)
    assert issubclass(hagen.SettingsError, ValueError)


def test_rejects_too_many_returns():
    with pytest.raises(ValueError, match="more than the 16777216"):
        hagen.Filter().segment(np.broadcast_to(np.float32(1), (10**9, 3)))
