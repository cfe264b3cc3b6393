"""Takes a screenshot of a replay in a browser. Usage: replay_picture.py REPLAY.html TIME_S PICTURE.png"""
import base64
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/browser"))
from webdriver import Browser  # noqa: E402

page, time_s, picture = sys.argv[1], float(sys.argv[2]), Path(sys.argv[3])
with Browser(1000, 760) as browser:
    browser.open(page)
    browser.wait_for("return document.body.dataset.step !== undefined;")
    browser.run("const time = document.getElementById('time'); time.value = arguments[0];"
                "time.dispatchEvent(new Event('input'));", time_s)
    shot = browser.call("GET", browser.session + "/screenshot")
picture.write_bytes(base64.b64decode(shot))
