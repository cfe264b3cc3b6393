#!/usr/bin/env python3
"""Opens pages of rawlog-segment --view in a browser, and compares their data with --clouds.
Usage: view_test.py PROGRAMS-FOLDER SOURCE-FOLDER"""
import base64
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

from webdriver import Browser, changed

programs, source = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
program = programs / "rawlog-segment"
ORCHARD = source / "rawlogs/orchard.rawlog"
SIZES = {"u8": 1, "u16": 2, "i16": 2, "i32": 4}


def check(holds, what):
    assert holds, what
    print("ok:", what)


def view(recording, page, *flags):
    result = subprocess.run([program, recording, "--view", page, "--overwrite", *flags],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return result.stdout


def data_of(page):
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"<(?:script|link|img|iframe)[^>]*\b(?:src|href)=", text), "loads a file"
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])


def unpacked(packed):
    raw, at, arrays = zlib.decompress(base64.b64decode(packed["data"])), 0, {}
    for name, kind, count, is_differences in packed["arrays"]:
        planes = [raw[at + k * count:at + (k + 1) * count] for k in range(SIZES[kind])]
        at += SIZES[kind] * count
        bits, values, last = 8 * SIZES[kind], [], 0
        for column in zip(*planes):
            value = int.from_bytes(bytes(column), "little")
            last = (last + value) % 2 ** bits if is_differences else value
            values.append(last - 2 ** bits if kind[0] == "i" and last >= 2 ** (bits - 1) else last)
        arrays[name] = values
    assert at == len(raw)
    return arrays


def cloud_of(file):
    """x, y, z and label of the points of a binary PLY."""
    raw = file.read_bytes()
    head, body = raw.split(b"end_header\n", 1)
    fields = re.findall(rb"property (\w+) (\w+)", head)
    codes = {b"float": "f", b"float32": "f", b"double": "d", b"uchar": "B", b"uint8": "B",
             b"ushort": "H", b"uint16": "H", b"uint": "I", b"uint32": "I", b"int": "i", b"int32": "i"}
    layout = struct.Struct("<" + "".join(codes[kind] for kind, _ in fields))
    places = [[name for _, name in fields].index(name) for name in (b"x", b"y", b"z", b"label")]
    return [tuple(point[place] for place in places) for point in layout.iter_unpack(body)]


def check_data(folder):
    """The page has every return of the labelled clouds, rounded, with its label."""
    page = folder / "orchard.html"
    view(ORCHARD, page, "--clouds", folder / "clouds", "--from", "0", "--to", "4")
    packed = data_of(page)["frames"][0]
    frame, (rows, columns) = unpacked(packed), packed["image"]
    cloud = [point for point in cloud_of(sorted((folder / "clouds").glob("*.ply"))[0])
             if point[3] != 0]
    check(len(frame["range"]) == len(cloud), f"the page has all {len(cloud)} returns")
    cells = {}
    for x, y, z, label in cloud:
        cells.setdefault((round(x), round(y), round(z)), []).append((x, y, z, label))
    lost = 0
    azimuths, offsets = iter(frame["azimuth"]), iter(frame["offset"])
    for range_, elevation, label, pixel in zip(*(frame[name] for name in (
            "range", "elevation", "label", "pixel"))):
        range_m, elevation_rad = range_ * 0.04, elevation * 0.0005
        if pixel < 0:
            azimuth_rad = next(azimuths) * math.pi / 8192
        else:
            azimuth_rad = math.pi - 2 * math.pi / columns * (
                pixel // rows + 0.5 - (next(offsets) - 128) / 8)
        at = (range_m * math.cos(elevation_rad) * math.cos(azimuth_rad),
              range_m * math.cos(elevation_rad) * math.sin(azimuth_rad), range_m * math.sin(elevation_rad))
        tolerance = 0.021 + 0.001 * range_m
        around = [point for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                  for point in cells.get((round(at[0]) + dx, round(at[1]) + dy, round(at[2]) + dz), [])]
        lost += not any(point[3] == label and math.dist(point[:3], at) < tolerance for point in around)
    check(lost == 0, f"returns have the place and label of the labelled cloud ({lost} do not)")


def check_page(page):
    data = data_of(page)
    per_scan = sum(len(json.dumps(frame)) for frame in data["frames"]) / len(data["frames"])
    check(500 * per_scan < 39e6, f"500 scans need {500 * per_scan / 1e6:.1f} MB")
    with Browser(1280, 900) as browser:
        browser.open(page)
        browser.wait_for("return document.body.dataset.frame === '0';")
        browser.run("document.getElementById('stages').open = true;")
        seen = {}
        for number, mode in enumerate(("obstacle", "RoI / ROU", "height", "intensity", "range", "ring")):
            browser.press(str(number + 1))
            check(browser.run("return document.body.dataset.mode;") == mode, f"key {number + 1}: {mode}")
            seen[mode] = browser.picture()
        for mode, picture in seen.items():
            least = min(changed(picture, other) for name, other in seen.items() if name != mode)
            check(least > 2, f"{mode} differs from each other mode in {least:.0f} per mille")
        for layer in ("roi", "rou", "boxes", "ground", "flown"):
            difference = browser.toggled(layer)
            check(difference > 0.5, f"layer {layer} changes {difference:.1f} per mille")
        before = browser.picture()
        browser.drag("#view canvas", (0, 100), (80, 120), "touch")
        check(changed(before, browser.picture()) > 20, "a finger turns the view")
        browser.drag("#stages [data-stage=labels]", (100, 0), (101, 0))
        check(int(browser.run("return document.body.dataset.marked;")) >= 0, "the pointer marks a pixel")
        for stage in ("depth", "maxima", "angle", "smoothed", "labels"):
            shades = browser.run(f"""const canvas = document.querySelector('[data-stage={stage}]');
                const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
                return new Set(new Uint32Array(pixels.buffer)).size;""")
            check(shades > 2, f"stage {stage} has {shades} colours")
        browser.press("\ue014")  # right arrow
        browser.wait_for("return document.body.dataset.frame === '1';")
        browser.click("#play")
        browser.wait_for("return Number(document.body.dataset.frame) > 3;")
        browser.press("\ue00d")  # space
        browser.press("\ue011")  # home
        browser.wait_for("return document.body.dataset.frame === '0';")
        browser.drag("#chart", (200, 0), (201, 0))
        browser.wait_for("return Number(document.body.dataset.frame) > 10;")
        check(True, "keys, button and chart move in time")
        check(browser.errors() == [], "no errors")


def write_las(file):
    """LAS 1.2, point format 0: a wall and the ground, in millimetres."""
    points = [(6000, y, z) for y in range(-3000, 3000, 50) for z in range(-1500, 2000, 100)]
    points += [(x, y, -1500) for x in range(500, 6000, 100) for y in range(-3000, 3000, 100)]
    head = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2, b"", b"",
                       1, 2026, 227, 227, 0, 0, 20, len(points), len(points), 0, 0, 0, 0)
    head += struct.pack("<12d", *[0.001] * 3, *[0.0] * 3, 6, 0.5, 3, -3, 2, -1.5)
    file.write_bytes(head + b"".join(struct.pack("<3iHBBbBH", *point, 100, 9, 0, 0, 0, 0) for point in points))


def check_inputs(folder):
    """Every kind of input opens without an error."""
    for flags in (("--kitti", folder / "kitti", "--clouds", folder / "clouds"),
                  ("--mcap", folder / "orchard.mcap", "--clouds", folder / "pcd", "--cloud-format", "pcd")):
        subprocess.run([program, ORCHARD, *flags, "--overwrite", "-q", "--to", "9"], check=True)
    subprocess.run([programs / "make-recordings", source / "rawlogs/poles_and_wall.rawlog", folder], check=True)
    write_las(folder / "wall.las")
    inputs = [folder / name for name in ("kitti", "kitti/velodyne", "clouds", "pcd", "wall.las", "orchard.mcap", "flight.pcap",
                                         "livox.pcap", "flight.bag", "flight.mcap", "flight.db3")]
    for variable, names in (("HAGEN_VELODYNE_DATA", ("*vlp16_gps.pcap", "*hdl32.pcap")),
                            ("HAGEN_OUSTER_DATA", ("OS-0-32*.pcap", "OS-1-128*.pcap")),
                            ("HAGEN_FIELD_DATA", ("*.bag", "*.npy", "scalar*.ply"))):
        place = os.environ.get(variable)
        if not place:
            print(f"skipped: {variable} is not set")
            continue
        inputs += [file for name in names for file in sorted(pathlib.Path(place).glob(name))[:1]]
    for recording in inputs:
        flags, page = ["--to", "20"], folder / "page.html"
        metadata = recording.with_name(recording.stem.removesuffix("_lb_n3") + ".json")
        if recording.suffix == ".pcap" and metadata.exists():
            flags += ["--sensor-json", metadata]
        view(recording, page, *flags)
        with Browser() as browser:
            browser.open(page)
            browser.wait_for("return document.body.dataset.frame === '0';")
            check(browser.toggled("roi") + browser.toggled("rou") > 0.3 and browser.errors() == [],
                  f"{recording.name} ({page.stat().st_size / 1e6:.1f} MB)")


with tempfile.TemporaryDirectory() as place:
    place = pathlib.Path(place)
    check_data(place)
    view(ORCHARD, place / "all.html")
    check_page(place / "all.html")
    check_inputs(place)
