"""Checks that the targets of all links, pictures, scripts and styles of the built site exist, including anchors.

Usage: check_built.py SITE
"""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """The link targets and the anchors of a page."""

    def __init__(self, file):
        super().__init__()
        self.targets, self.places = [], set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.places.add(value)
            if name in ("href", "src") and value:
                self.targets.append((tag, value))


def main():
    site = Path(sys.argv[1]).resolve()
    read = {}
    page_of = lambda file: read.setdefault(file, Page(file)) if file not in read else read[file]
    faults = []
    for file in sorted(site.glob("*.html")):
        for tag, target in page_of(file).targets:
            url = urlsplit(target)
            if url.scheme or url.netloc:
                if tag not in ("a",):  # external resources are not allowed
                    faults.append(f"{file.name}: {tag} loads {target}")
                continue
            to = (file.parent / unquote(url.path)).resolve() if url.path else file
            if to.is_dir():
                to = to / "index.html"
            if not to.is_relative_to(site) or not to.exists():
                if file.name != "404.html":  # its links begin with /
                    faults.append(f"{file.name}: {target} is missing")
            elif url.fragment and to.suffix == ".html" and unquote(url.fragment) not in page_of(to).places:
                faults.append(f"{file.name}: {target}: no such anchor")
    print(*faults, sep="\n", end="\n" if faults else "", file=sys.stderr)
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
