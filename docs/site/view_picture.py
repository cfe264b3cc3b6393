"""Takes a screenshot of a page of the viewer in a browser; a .webp is an animation that begins at this time.
Usage: view_picture.py PAGE TIME_S PICTURE [WIDTHxHEIGHT] [JAVASCRIPT]"""
import io
import sys
from pathlib import Path

from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/browser"))
from webdriver import Browser  # noqa: E402

FRAMES, PERIOD_MS = 24, 200
SEEK = """const time = document.getElementById('time'); time.value = arguments[0];
          if (!time.hidden) time.dispatchEvent(new Event('input'));"""

page, time_s, picture = sys.argv[1], float(sys.argv[2]), Path(sys.argv[3])
width, height = map(int, sys.argv[4].split("x")) if len(sys.argv) > 4 else (1000, 760)


def shot(browser, at_s):
    browser.run(SEEK, at_s)
    browser.wait_for("return [undefined, document.body.dataset.frame].includes(document.body.dataset.wanted);")
    return Image.open(io.BytesIO(browser.screenshot())).convert("RGB")


with Browser(width, height) as browser:
    browser.open(page)
    browser.wait_for("return document.body.dataset.frame >= 0 && document.getElementById('figures').childNodes.length > 1;")
    browser.run("".join(sys.argv[5:]) or ";")
    first, *others = [shot(browser, time_s + PERIOD_MS / 1000 * i)
                      for i in range(FRAMES if picture.suffix == ".webp" else 1)]
options = {"save_all": True, "append_images": others, "duration": PERIOD_MS, "loop": 0, "quality": 30, "method": 4}
first.save(picture, **options if others else {})
