#!/usr/bin/env python3
"""Opens replay pages of octomap-compare in a browser and plays them.
Usage: pages_test.py OCTOMAP-COMPARE"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from webdriver import Browser

program = pathlib.Path(sys.argv[1]).resolve()

STATE = "return {...document.body.dataset};"


def command(*arguments):
    subprocess.run([program, *arguments], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def check(holds, what):
    assert holds, what
    print("ok:", what)


def check_offline(page):
    text = page.read_text(encoding="utf-8")
    # URLs in comments and library namespaces are not loaded.
    check(not re.search(r"<(?:script|link|img|iframe)[^>]*\b(?:src|href)=", text),
          f"{page.name} is self-contained")


# Open panels that overlap or extend beyond the window.
OVERLAPS = """
document.getElementById('layers').open = true;
const boxes = ['header', '#layers', 'footer'].map(
    name => [name, document.querySelector(name).getBoundingClientRect()]);
const wrong = [];
boxes.forEach(([name, a], i) => {
  if (a.left < 0 || a.top < 0 || a.right > innerWidth || a.bottom > innerHeight) wrong.push(name);
  for (const [other, b] of boxes.slice(i + 1)) {
    if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) {
      wrong.push(name + ' over ' + other);
    }
  }
});
return wrong;"""


def check_panels(page):
    for width, height in ((1280, 800), (400, 900), (400, 500), (800, 450)):
        with Browser(width, height) as browser:
            browser.open(page)
            browser.wait_for("return document.body.dataset.frame !== undefined;")
            wrong = browser.run(OVERLAPS)
            check(wrong == [], f"{width} x {height} px: panels do not overlap {wrong}")


def check_crash(folder):
    """A replay ends at the end of the flight, not at its last plan."""
    with open(folder / "runs.csv", encoding="utf-8") as table:
        collisions = [row for row in csv.DictReader(table) if row["outcome"] == "collision"]
    check(collisions, "one of the fast flights with late plans collides")
    row = collisions[0]
    command("replay", folder, "--seed", row["seed"])
    page = folder / f"replay-forest-0.10-{row['seed']}-W-RoI-straight-14mps-latency16.html"
    with Browser() as browser:
        browser.open(page)
        browser.wait_for("return document.body.dataset.frame !== undefined;")
        ending = browser.run("return document.querySelector('#notes p').textContent;")
        check(re.fullmatch(rf"Hit a tree at {float(row['time_s']):.2f} s: "
                           rf"{float(row['min_clearance_m']):.2f} m from .*", ending), ending)
        browser.press("\ue010")  # End
        end = browser.run(STATE)
        check(abs(float(end["time"]) - float(row["time_s"])) < 0.011, "the replay ends at impact")
        check(abs(float(end["clearance"]) - float(row["min_clearance_m"])) < 0.011,
              f"the final clearance matches the table: {end['clearance']} m")
        browser.press("\ue012")  # left arrow
        last = browser.run(STATE)
        check(last["frame"] == end["frame"] and float(last["time"]) < float(end["time"]),
              "the last plan precedes the impact")
        browser.press("\ue014")  # right arrow
        check(browser.run(STATE) == end, "the step after the last plan is the end")
        check(browser.toggled("scene") > 50, "the true scene can be toggled")
        check(browser.errors() == [], "no errors")


def check_replay(folder, model):
    command("replay", folder, "--seed", "0", "--model", model, "-o", folder / "replays")
    page = folder / "replays" / f"replay-gap-0-{model}-astar-4mps.html"
    check_offline(page)
    check(page.stat().st_size < 15e6, f"{model}: {page.stat().st_size / 1e6:.1f} MB")
    with Browser() as browser:
        browser.open(page)
        browser.wait_for("return document.body.dataset.frame !== undefined;")
        begin = browser.run(STATE)
        browser.press("\ue014")  # right arrow
        stepped = browser.run(STATE)
        check(int(stepped["frame"]) == int(begin["frame"]) + 1, f"{model}: a key advances one step")
        browser.run("""const slider = document.getElementById('time');
            slider.value = slider.max / 2; slider.dispatchEvent(new Event('input'));""")
        middle = browser.run(STATE)
        check(int(middle["frame"]) > 10 and int(middle["held"]) > 10,
              f"{model}: the slider moves ({middle})")
        colors = browser.run("""
            const slider = document.getElementById('time');
            slider.dispatchEvent(new Event('input'));  // draws; the picture holds until the next frame
            const copy = document.createElement('canvas');
            copy.width = 200; copy.height = 120;
            const pen = copy.getContext('2d');
            pen.drawImage(document.querySelector('#view canvas'), 0, 0, 200, 120);
            const pixels = pen.getImageData(0, 0, 200, 120).data, seen = new Set();
            for (let i = 0; i < pixels.length; i += 4) {
              seen.add((pixels[i] >> 4) * 256 + (pixels[i + 1] >> 4) * 16 + (pixels[i + 2] >> 4));
            }
            return seen.size;""")
        check(colors > 20, f"{model}: the view is not blank ({colors} colours)")
        browser.click("#play")
        browser.wait_for(f"return Number(document.body.dataset.time) > {middle['time']} + 0.3;")
        check(True, f"{model}: the button plays")
        browser.press("\ue00d")  # space
        paused = browser.run(STATE)
        time.sleep(0.5)
        check(browser.run(STATE) == paused, f"{model}: space pauses")
        browser.press("\ue010")  # end
        end = browser.run("return [document.getElementById('time').max, "
                          "document.body.dataset.time].map(Number);")
        check(abs(end[0] - end[1]) < 0.01, f"{model}: the End key jumps to the end")
        check(browser.errors() == [], f"{model}: no errors")


with tempfile.TemporaryDirectory() as place:
    place = pathlib.Path(place)
    flown = place / "flown"
    command("closedloop", "--scenario", "gap", "--seeds", "0-0", "--models", "W-RoI,O-Full-0.4",
            "-o", flown)
    for one in ("W-RoI", "O-Full-0.4"):
        check_replay(flown, one)
    check_panels(flown / "replays/replay-gap-0-O-Full-0.4-astar-4mps.html")
    command("closedloop", "--scenario", "forest-0.10", "--seeds", "1-3", "--models", "W-RoI",
            "--guidance", "straight", "--speed", "14", "--latency-scale", "16", "-o",
            place / "crash")
    check_crash(place / "crash")
