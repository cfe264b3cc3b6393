#!/usr/bin/env python3
"""Opens the pages of octomap-compare in a browser: do charts get drawn, does the replay play?
Usage: pages_test.py OCTOMAP-COMPARE"""
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from webdriver import Browser

HERE = pathlib.Path(__file__).parent
program = pathlib.Path(sys.argv[1]).resolve()

# Coloured pixels of each canvas: axes and words are grey, data are not.
PAINTED = """
return [...document.querySelectorAll('canvas')].map(canvas => {
  const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let painted = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const rgb = [pixels[i], pixels[i + 1], pixels[i + 2]];
    if (pixels[i + 3] > 128 && Math.max(...rgb) - Math.min(...rgb) > 60) ++painted;
  }
  return painted;
});"""
STATE = "return {...document.body.dataset};"


def command(*arguments):
    subprocess.run([program, *arguments], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def check(holds, what):
    assert holds, what
    print("ok:", what)


def check_offline(page):
    text = page.read_text(encoding="utf-8")
    # Addresses in comments and namespaces of libraries are none that a page loads.
    check(not re.search(r"<(?:script|link|img|iframe)[^>]*\b(?:src|href)=", text),
          f"{page.name} loads nothing from elsewhere")


def check_report(folder):
    subprocess.run([sys.executable, HERE / "sample_runs.py", folder], check=True)
    command("report", folder, "--worst", "0")
    page = folder / "report.html"
    check_offline(page)
    for width in (1280, 400):
        with Browser(width, 900) as browser:
            browser.open(page)
            painted = browser.run(PAINTED)
            check(len(painted) == 10, f"{width} px: all charts are there ({len(painted)})")
            check(min(painted) > 300, f"{width} px: no chart is blank ({min(painted)} pixels)")
            overflow = browser.run(
                "return document.documentElement.scrollWidth - window.innerWidth;")
            check(overflow <= 0, f"{width} px: the page is no wider than the window")
            wide = browser.run("""
                return [...document.querySelectorAll('body *')].filter(
                  element => element.getBoundingClientRect().right > window.innerWidth + 1 &&
                             !element.closest('.scroll')).map(element => element.tagName);""")
            check(wide == [], f"{width} px: only boxes of tables scroll sideways {wide[:3]}")
            hidden = browser.run("""
                return [...document.querySelectorAll('section .scroll')].filter(
                  box => box.scrollWidth > box.clientWidth).length;""")
            check(width < 1280 or hidden == 0, f"{width} px: tables fit ({hidden} do not)")
            check(browser.errors() == [], f"{width} px: no errors")


def check_replay(folder, model):
    command("replay", folder, "--seed", "0", "--model", model, "-o", folder / model)
    page = folder / model / "replay.html"
    check_offline(page)
    check(page.stat().st_size < 15e6, f"{model}: {page.stat().st_size / 1e6:.1f} MB")
    with Browser() as browser:
        browser.open(page)
        browser.wait_for("return document.body.dataset.step !== undefined;")
        begin = browser.run(STATE)
        browser.press("\ue014")  # arrow to the right
        stepped = browser.run(STATE)
        check(int(stepped["step"]) == int(begin["step"]) + 1, f"{model}: a key goes on a step")
        browser.run("""const slider = document.getElementById('time');
            slider.value = slider.max / 2; slider.dispatchEvent(new Event('input'));""")
        middle = browser.run(STATE)
        check(int(middle["step"]) > 10 and int(middle["held"]) > 10,
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
        check(True, f"{model}: it plays")
        browser.press("\ue00d")  # space
        paused = browser.run(STATE)
        time.sleep(0.5)
        check(browser.run(STATE) == paused, f"{model}: space pauses")
        browser.press("\ue010")  # end
        end = browser.run("return [document.getElementById('time').max, "
                          "document.body.dataset.time].map(Number);")
        check(abs(end[0] - end[1]) < 0.01, f"{model}: the key End leads to the end")
        check(browser.errors() == [], f"{model}: no errors")


with tempfile.TemporaryDirectory() as place:
    place = pathlib.Path(place)
    check_report(place / "sample")
    flown = place / "flown"
    command("closedloop", "--scenario", "gap", "--seeds", "0-0", "--models", "W-RoI,O-Full-0.4",
            "--profile", place / "sample/profile.json", "-o", flown)
    command("report", flown, "--worst", "1")
    worst = (flown / "report.html").read_text(encoding="utf-8")
    check('class="overhead"' in worst and "came out otherwise" not in worst,
          "the worst run is shown, and came out again as it was")
    for one in ("W-RoI", "O-Full-0.4"):
        check_replay(flown, one)
