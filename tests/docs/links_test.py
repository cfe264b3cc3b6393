"""Checks that each link in the documentation leads to an existing page, heading, picture or file.

URLs are not opened. Usage: links_test.py [PAGE.md...]; default: all pages.
"""
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/site"))
import pages  # noqa: E402


def faults(path, read=lambda path: path.read_text()):
    """One line for each broken link of a page."""
    found = []
    for line, target, is_picture in pages.links(read(path)):
        where = f"{path}:{line}: {target}: "
        if "://" in target or target.startswith("mailto:"):
            if is_picture:
                found.append(where + "a picture of another site")
            continue
        name, _, anchor = target.partition("#")
        file = Path(os.path.normpath(path.parent / name)) if name else path
        if not file.exists():
            found.append(where + "no such file")
        elif is_picture and (file.suffix not in (".png", ".svg", ".webp") or file.stat().st_size == 0):
            found.append(where + "not a picture")
        elif anchor and (file.suffix != ".md" or anchor not in pages.anchors(read(file))):
            found.append(where + "no such heading")
    return found


class Links(unittest.TestCase):
    def test_no_link_is_broken(self):
        found = [fault for page in pages.all_pages() for fault in faults(pages.ROOT / page)]
        self.assertEqual(found, [])

    def test_every_picture_is_shown(self):
        shown = set()
        for page in pages.all_pages():
            folder = (pages.ROOT / page).parent
            shown |= {os.path.normpath(folder / target) for _, target, _ in pages.links((pages.ROOT / page).read_text())}
        there = {str(path) for path in (pages.ROOT / "docs/pictures").glob("*")}
        self.assertEqual(there - shown, set())

    def faults_of(self, text):
        page = pages.ROOT / "docs/live.md"
        return faults(page, lambda path: text if path == page else path.read_text())

    def test_reports_missing_files_headings_and_pictures(self):
        for link in ("[a](nowhere.md)", "[a](python.md#nothing)", "[a](#nothing)", "![a](pictures/none.png)",
                     "![a](python.md)", "![a](https://example.org/a.png)", "[![a](none.png)](python.md)"):
            self.assertEqual(len(self.faults_of(f"# One\n{link}\n")), 1, link)

    def test_anchors_match_github(self):
        text = "# `a`-b, [c](d.md): 1.5 m?\n## Twice\n## Twice\n```\n# no heading\n```\n"
        self.assertEqual(pages.anchors(text), {"a-b-c-15-m", "twice", "twice-1"})

    def test_ignores_links_in_code(self):
        self.assertEqual(self.faults_of("`[a](nowhere.md)`\n```\n[a](nowhere.md)\n```\n[one](python.md#segment)\n"), [])


if __name__ == "__main__":
    if len(sys.argv) > 1 and sys.argv[1].endswith(".md"):
        found = [fault for name in sys.argv[1:] for fault in faults(Path(name).resolve())]
        print(*found, sep="\n")
        sys.exit(bool(found))
    unittest.main()
