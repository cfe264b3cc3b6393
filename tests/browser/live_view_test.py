#!/usr/bin/env python3
"""Watches live-segment --view with good, slow and hostile clients: all labels are those of a run
without viewers. Usage: live_view_test.py PROGRAMS-FOLDER [SECONDS]"""
import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import threading
import time

from webdriver import Browser

programs = pathlib.Path(sys.argv[1]).resolve()
seconds = int(sys.argv[2]) if len(sys.argv) > 2 else 20


def check(holds, what):
    assert holds, what
    print("ok:", what)


def free_port():
    with socket.socket() as any_port:
        any_port.bind(("127.0.0.1", 0))
        return any_port.getsockname()[1]


def client(port, text):
    made = socket.create_connection(("127.0.0.1", port), timeout=10)
    made.sendall(text)
    return made


def count_events(port, counts, end):
    with client(port, b"GET /events HTTP/1.1\r\nHost: hagen\r\n\r\n") as reader:
        events = 0
        while time.monotonic() < end:
            received = reader.recv(1 << 16)
            if not received:
                break
            events += received.count(b"data: ")
        counts.append(events)


def run(capture, folder, *flags):
    stats = folder / "stats.json"
    return stats, subprocess.Popen([programs / "live-segment", "--replay", capture, "--model", "VLP-16", "--stats",
                                    stats, "--overwrite", "-q", *flags])


with tempfile.TemporaryDirectory() as place:
    place = pathlib.Path(place)
    subprocess.run([programs / "rawlog-simulate", "--scenario", "forest-0.05", "--scans", str(10 * seconds),
                    "--altitude", "3", "--seed", "1", "--pcap", place / "flight.pcap", "-q"], check=True)
    stats, alone = run(place / "flight.pcap", place)
    assert alone.wait() == 0
    expected = json.loads(stats.read_text())
    port, counts = free_port(), []
    with Browser() as browser:
        stats, watched = run(place / "flight.pcap", place, "--view", str(port))
        time.sleep(0.5)
        end = time.monotonic() + seconds - 2
        readers = [threading.Thread(target=count_events, args=(port, counts, end)) for _ in range(3)]
        for reader in readers:
            reader.start()
        silent = client(port, b"GET /events HTTP/1.1\r\nHost: hagen\r\n\r\n")
        hostile = [client(port, bytes(range(256)) * 400), client(port, b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 1000)]
        browser.open(f"http://127.0.0.1:{port}/")
        browser.wait_for("return Number(document.body.dataset.frame) > 5;")
        check(browser.toggled("roi") > 5, "the page shows regions of interest")
        check(browser.toggled("directions") > 1, "the page shows the directions")
        check(browser.run("return document.querySelectorAll('#figures dd').length;") >= 8, "the page shows latency and losses")
        errors = browser.errors()
        check(errors == [], f"no errors {errors}")
    for reader in readers:
        reader.join()
    check(min(counts) > 5, f"each reader received {min(counts)} frames or more")
    check(watched.wait(timeout=seconds + 20) == 0, "the session ends")
    seen = json.loads(stats.read_text())
    dropped = expected["packets"]["dropped"] + seen["packets"]["dropped"]
    for name in ("sectors", "returns", "roi") if dropped == 0 else ():  # a busy machine drops packets
        check(seen[name] == expected[name], f"{name}: {seen[name]}, as without viewers")
    for name in ("p50", "p99", "p99.9"):
        print(f"latency {name}, without and with viewers: {expected['latency_ms'][name]}, {seen['latency_ms'][name]} ms")
