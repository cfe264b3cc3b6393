"""hagen.open(), compared with rawlog-segment on the same recording."""
import gzip
import os
import signal
import struct
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import ORCHARD, POLES

import hagen


def test_labels_match_program(poles_labels):
    segmenter = hagen.Filter("vlp16")
    files = sorted((poles_labels / "labels").glob("*.label"))
    scans = 0
    for scan in hagen.open(POLES):
        result = segmenter.segment(scan)
        expected = np.fromfile(files[scans], np.uint32)
        np.testing.assert_array_equal(result.labels, expected & 0xFFFF)
        np.testing.assert_array_equal(result.obstacles, expected >> 16)
        points = np.fromfile(poles_labels / "velodyne" / f"{files[scans].stem}.bin", np.float32)
        np.testing.assert_array_equal(scan.xyz, points.reshape(-1, 4)[:, :3])
        np.testing.assert_array_equal(scan.intensity, points.reshape(-1, 4)[:, 3])
        scans += 1
    assert scans == len(files) == 10


def test_recording_settings_are_local(poles_labels, tmp_path):
    """The settings of a deleted recording do not affect later scans."""
    folder = tmp_path / "near"
    (folder / "velodyne").mkdir(parents=True)
    scan = sorted((poles_labels / "velodyne").glob("*.bin"))[0]
    (folder / "velodyne" / scan.name).write_bytes(scan.read_bytes())
    (folder / "sensor.yaml").write_text("sensor: {model: VLP-16}\nzone_m: 3\n")
    simulated = next(hagen.simulate("orchard", seed=1))
    expected = hagen.Filter("vlp16").segment(simulated).labels.copy()
    segmenter = hagen.Filter("vlp16")
    near = segmenter.segment(next(iter(hagen.open(folder)))).labels  # destroys recording and scan
    assert np.count_nonzero(near == hagen.ROI) < np.count_nonzero(
        hagen.Filter("vlp16").segment(next(iter(hagen.open(poles_labels)))).labels == hagen.ROI
    )
    np.testing.assert_array_equal(segmenter.segment(simulated).labels, expected)


def test_points_alone_give_similar_labels():
    """Without the packets' rows and azimuths, some returns move to other pixels."""
    segmenter = hagen.Filter("vlp16")
    for scan in hagen.open(POLES):
        with_packets = segmenter.segment(scan).labels
        assert np.mean(segmenter.segment(scan.xyz).labels == with_packets) > 0.999


def test_scan_attributes():
    recording = hagen.open(POLES)
    scans = list(recording)
    assert len(scans) == 10
    assert sum(map(len, scans)) == 157114  # rawlogs/README.md
    first = scans[0]
    assert first.xyz.shape == (len(first), 3) and first.xyz.dtype == np.float32
    assert first.intensity.shape == (len(first),) and first.intensity.dtype == np.float32
    assert first.ring.dtype == np.uint8 and set(first.ring) <= set(range(16))
    assert first.times.dtype == np.float32 and 0.09 < first.times.max() < 0.11
    assert first.sensor == "VLP-16" and first.sensor_label == "lidar"
    assert scans[1].time - first.time == pytest.approx(0.1)

    # The vehicle flies at 3 m/s, 1.2 m above the ground, level.
    assert first.pose.shape == (4, 4)
    np.testing.assert_allclose(scans[9].pose[:3, 3] - first.pose[:3, 3], [2.7, 0, 0], atol=1e-6)
    assert first.pose[2, 3] == pytest.approx(1.2)
    np.testing.assert_allclose(first.attitude, (0, 0), atol=1e-6)
    assert recording.poses and recording.remarks == []

    # The elevation of a return identifies its ring.
    elevation = np.arctan2(first.xyz[:, 2], np.hypot(first.xyz[:, 0], first.xyz[:, 1]))
    np.testing.assert_allclose(np.degrees(elevation), 2.0 * first.ring - 15, atol=0.05)
    assert first.truth is None and first.altitude_m is None


def test_selects_scans():
    scans = list(hagen.open(ORCHARD, first=10, last=12))
    assert [scan.entry for scan in scans] == [10, 11, 12]
    assert list(hagen.open(str(ORCHARD), sensor_labels=["other"])) == []


def test_selects_sensor_labels():
    assert len(list(hagen.open(POLES, sensor_labels="lidar"))) == 10
    recording = hagen.open(POLES, sensor_labels="liadr")
    assert recording.remarks == []
    assert list(recording) == []
    remark = "no entry that was read has a LiDAR scan of '{}'; there are 'lidar'"
    assert recording.remarks == [remark.format("liadr")]
    recording = hagen.open(POLES, sensor_labels=("lidar", "rear"))
    assert len(list(recording)) == 10
    assert recording.remarks == [remark.format("rear")]


def test_scan_outlives_recording():
    scan = next(hagen.open(POLES))
    expected = hagen.Filter("vlp16").segment(next(hagen.open(POLES))).labels
    np.testing.assert_array_equal(hagen.Filter("vlp16").segment(scan).labels, expected)


def test_reads_point_cloud_files(tmp_path):
    scan = next(hagen.open(ORCHARD))
    np.save(tmp_path / "cloud.npy", scan.xyz)
    cloud = next(hagen.open(tmp_path / "cloud.npy"))
    np.testing.assert_array_equal(cloud.xyz, scan.xyz)
    assert cloud.pose is None and cloud.name == "cloud"
    assert cloud.sensor == "VLP-16"  # beams recovered
    # Beams from the settings override those estimated from the cloud.
    named = hagen.Filter("vlp16").segment(cloud)
    np.testing.assert_array_equal(named.labels, hagen.Filter("vlp16").segment(scan.xyz).labels)


def test_given_attitude_overrides_recording():
    scan = next(hagen.open(ORCHARD))
    segmenter = hagen.Filter("vlp16")
    own = segmenter.segment(scan).labels
    np.testing.assert_array_equal(segmenter.segment(scan, attitude=scan.attitude).labels, own)
    wrong = segmenter.segment(scan, attitude=(np.pi, 0)).labels
    assert not np.array_equal(wrong, own)


def test_reports_unreadable_files(tmp_path):
    with pytest.raises(FileNotFoundError, match="no_such.rawlog"):
        hagen.open(tmp_path / "no_such.rawlog")
    with pytest.raises(FileNotFoundError, match="no_such.tum"):
        hagen.open(POLES, poses=tmp_path / "no_such.tum")
    text = tmp_path / "notes.txt"
    text.write_text("no recording\n")
    with pytest.raises(RuntimeError, match="notes.txt"):
        list(hagen.open(text))
    with pytest.raises(RuntimeError, match="poles_and_wall"):
        hagen.open(POLES, topics=["/points"])
    with pytest.raises(TypeError):
        hagen.open(7)


def test_shows_non_utf8_texts(tmp_path):
    """Sensor labels and file names may contain arbitrary bytes."""
    recording = tmp_path / os.fsdecode(b"fl\xffght.rawlog")
    recording.write_bytes(gzip.decompress(POLES.read_bytes()).replace(b"lidar", b"lid\xffr"))
    scans = hagen.open(recording)
    scan = next(scans)
    assert scan.sensor_label == "lid\ufffdr"
    assert "lid\ufffdr" in repr(scan) and "fl\ufffdght.rawlog" in repr(scans)
    assert isinstance(scans.remarks, list) and isinstance(scans.poses, str)
    assert scan.remark == "" and hagen.Filter().segment(scan).remark == ""


def test_non_utf8_names_round_trip(tmp_path):
    name = os.fsdecode(b"cl\xffud")
    np.save(tmp_path / f"{name}.npy", next(hagen.open(ORCHARD)).xyz)
    for file in (tmp_path / f"{name}.npy", os.fsencode(tmp_path / f"{name}.npy")):
        assert next(hagen.open(file)).name == name


def test_errors_show_non_utf8_names(tmp_path):
    folder = os.fsencode(tmp_path)
    with pytest.raises(FileNotFoundError, match="none\ufffd.pcd: no such file"):
        hagen.open(folder + b"/none\xff.pcd")
    (tmp_path / os.fsdecode(b"bad\xff.pcd")).write_text("# .PCD v0.7\nFIELDS x\n")
    with pytest.raises(RuntimeError, match="bad\ufffd.pcd: .+"):
        next(hagen.open(folder + b"/bad\xff.pcd"))
    (tmp_path / os.fsdecode(b"bad\xff.yaml")).write_text("zone: 5\n")
    with pytest.raises(hagen.SettingsError, match="bad\ufffd.yaml.*zone"):
        hagen.Filter(folder + b"/bad\xff.yaml")
    with pytest.raises(hagen.SettingsError, match="none\ufffd.yaml"):
        hagen.Filter(os.fsdecode(folder + b"/none\xff.yaml"))


def test_broken_recording_raises_after_scans(tmp_path):
    broken = tmp_path / "broken.rawlog"
    data = POLES.read_bytes()
    broken.write_bytes(data[: len(data) * 6 // 10])
    scans = 0
    with pytest.raises(RuntimeError, match="broken.rawlog"):
        for _ in hagen.open(broken):
            scans += 1
    assert 0 < scans < 10


def test_reads_with_large_heap():
    """Probing a rawlog limits only additional memory."""
    ballast = np.ones(200_000_000 // 8)
    assert len(list(hagen.open(POLES))) == 10
    assert ballast[-1] == 1


def test_long_read_is_interruptible(tmp_path):
    """The first call reads a capture without LiDAR packets to its end."""
    frame = b"\0" * 12 + b"\x08\x06" + b"\0" * 28  # ARP
    record = struct.pack("<IIII", 1700000000, 0, len(frame), len(frame)) + frame
    capture = tmp_path / "other.pcap"
    capture.write_bytes(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1) + 1_000_000 * record)

    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        with pytest.raises(KeyboardInterrupt):
            recording = iter(hagen.open(capture))
            signal.setitimer(signal.ITIMER_REAL, 0.001)
            next(recording)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_interrupted_recording_raises():
    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.001)
        with pytest.raises(KeyboardInterrupt):
            while True:
                list(hagen.open(POLES))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("scans", [lambda: hagen.open(POLES), lambda: hagen.simulate("gap", scans=10)])
def test_threads_share_iterator(scans):
    alone = [scan.xyz.tobytes() for scan in scans()]
    together, errors, iterator = [], [], scans()

    def read():
        try:
            together.extend(scan.xyz.tobytes() for scan in iterator)
        except BaseException as error:
            errors.append(error)

    threads = [threading.Thread(target=read) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert errors == []
    assert sorted(together) == sorted(alone)


def test_exit_while_daemon_reads():
    code = f"""
import sys, threading, time, hagen
def read():
    while True:
        for scan in hagen.open({str(POLES)!r}):
            hagen.Filter().segment(scan)
for _ in range(3):
    threading.Thread(target=read, daemon=True).start()
time.sleep(0.3)
sys.exit(0)
"""
    environment = {**os.environ, "PYTHONPATH": str(Path(hagen.__file__).parents[1])}
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", code], env=environment, timeout=60)
        assert ended.returncode == 0
