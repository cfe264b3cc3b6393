"""A headless Chromium, controlled via chromedriver (WebDriver protocol) with only the standard
library. Exits with 77 (skipped) if either is not installed."""
import base64
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

SKIPPED = 77

# The view as 200 x 120 pixels.
PICTURE = """
  document.querySelector('#follow').dispatchEvent(new Event('change'));  // draws
  const copy = document.createElement('canvas');
  copy.width = 200; copy.height = 120;
  const pen = copy.getContext('2d');
  pen.drawImage(document.querySelector('#view canvas'), 0, 0, 200, 120);
  return [...pen.getImageData(0, 0, 200, 120).data];"""


def changed(before, after):
    """Per mille of the pixels that differ visibly."""
    different = sum(any(abs(before[i + k] - after[i + k]) > 8 for k in range(3))
                    for i in range(0, len(before), 4))
    return 1000 * different / (len(before) / 4)


class Browser:
    def __init__(self, width=1280, height=800):
        for program in ("chromium", "chromedriver"):
            if shutil.which(program) is None:
                print(f"skipped: {program} is not installed")
                sys.exit(SKIPPED)
        self.profile = tempfile.mkdtemp(prefix="hagen-browser-")
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE,
                                       stderr=subprocess.DEVNULL, text=True)
        for line in self.driver.stdout:
            found = re.search(r"started successfully on port (\d+)", line)
            if found:
                self.address = f"http://127.0.0.1:{found[1]}"
                break
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
                   "--no-first-run", "--disable-background-networking",
                   "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                   f"--user-data-dir={self.profile}", f"--window-size={width},{height}"]
        answer = self.call("POST", "/session", {"capabilities": {"alwaysMatch": {
            "browserName": "chrome", "goog:chromeOptions": {"args": options},
            "goog:loggingPrefs": {"browser": "ALL"}}}})
        self.session = "/session/" + answer["sessionId"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.call("DELETE", self.session)
        finally:
            self.driver.terminate()
            self.driver.wait()
            shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data=data, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(error.read().decode()) from None

    def open(self, page):
        """Opens a file or an address."""
        is_address = str(page).startswith("http")
        url = page if is_address else pathlib.Path(page).resolve().as_uri()
        self.call("POST", self.session + "/url", {"url": url})

    def run(self, script, *arguments):
        return self.call("POST", self.session + "/execute/sync",
                         {"script": script, "args": list(arguments)})

    def picture(self):
        return self.run(PICTURE)

    def toggled(self, layer):
        """Per mille of the pixels that change when a layer is toggled."""
        click = f"document.querySelector('[data-layer={layer}]').click();"
        before = self.picture()
        self.run(click)
        after = self.picture()
        self.run(click)
        return changed(before, after)

    def drag(self, selector, start, end, kind="mouse"):
        """Moves a pressed pointer between two places, in pixels from the element's centre."""
        element = self.call("POST", self.session + "/element",
                            {"using": "css selector", "value": selector})
        move = [{"type": "pointerMove", "duration": 50, "x": x, "y": y, "origin": element}
                for x, y in (start, end)]
        self.call("POST", self.session + "/actions", {"actions": [
            {"type": "pointer", "id": kind, "parameters": {"pointerType": kind}, "actions": [
                move[0], {"type": "pointerDown", "button": 0}, move[1],
                {"type": "pointerUp", "button": 0}]}]})

    def press(self, key):
        self.call("POST", self.session + "/actions", {"actions": [
            {"type": "key", "id": "keys", "actions": [{"type": "keyDown", "value": key},
                                                      {"type": "keyUp", "value": key}]}]})

    def click(self, selector):
        element = self.call("POST", self.session + "/element",
                            {"using": "css selector", "value": selector})
        self.call("POST", f"{self.session}/element/{next(iter(element.values()))}/click", {})

    def wait_for(self, script, seconds=30):
        end = time.monotonic() + seconds
        while not self.run(script):
            assert time.monotonic() < end, f"timeout waiting for: {script}"
            time.sleep(0.1)

    def screenshot(self):
        """A picture of the window (PNG)."""
        return base64.b64decode(self.call("GET", self.session + "/screenshot"))

    def errors(self):
        """Errors on the console; warnings about slow software WebGL are ignored."""
        log = self.call("POST", self.session + "/se/log", {"type": "browser"})
        return [entry["message"] for entry in log if entry["level"] == "SEVERE"]
