"""The built site in a browser: search finds pages, from a web server and from files. Skipped without output/site.

Usage: site_test.py [SITE]
"""
import functools
import http.server
import sys
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/browser"))
import webdriver  # noqa: E402


class Silent(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def search(browser, url, words):
    """The pages found by the search field of a page, the best first."""
    browser.call("POST", browser.session + "/url", {"url": url})
    browser.wait_for("return document.querySelector('.md-search__input') !== null")
    # The field accepts no words before the index is loaded.
    browser.run("document.querySelector('#__search').click(); document.querySelector('.md-search__input').focus()")
    browser.run("const field = document.querySelector('.md-search__input'); field.value = arguments[0];"
                "for (const name of ['input', 'keyup']) field.dispatchEvent(new Event(name, {bubbles: true}))", words)
    browser.wait_for("return document.querySelectorAll('.md-search-result__link').length > 0")
    return browser.run("return [...document.querySelectorAll('.md-search-result__link')].map((link) => link.href)")


def main():
    site = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "output/site").resolve()
    if not (site / "index.html").exists():
        print(f"skipped: {site} is not built; run scripts/site")
        return webdriver.SKIPPED
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with webdriver.Browser(1400, 1000) as browser:
        for base in (f"http://127.0.0.1:{server.server_port}", site.as_uri()):
            found = search(browser, base + "/python.html", "learn-airframe")
            assert any("rawlog-segment.html" in page for page in found), found
            assert all(page.startswith(base) for page in found), found
            assert browser.errors() == [], browser.errors()
            print(f"{base}: {len(found)} results")
    return 0


if __name__ == "__main__":
    sys.exit(main())
