"""Prepares the pages of the site for mkdocs: Markdown with adapted links, and the linked pictures and sources.

Usage: stage.py FOLDER    writes FOLDER/docs (whose subfolder api already contains Doxygen's pages) and FOLDER/mkdocs.yml
"""
import os
import re
import shutil
import sys
import xml.etree.ElementTree
from pathlib import Path

import yaml

import pages

# Pages with other names on the site; all others keep their names.
NAMES = {"README.md": "index.md", "rawlogs/README.md": "recordings.md"}


def page_name(path):
    """The site's page for a Markdown file."""
    return NAMES.get(str(path)) or path.name.lower()


def api_pages(tags):
    """Doxygen's page for each public header, by the header's path in the project."""
    found = {}
    for file in xml.etree.ElementTree.parse(tags).getroot().iter("compound"):
        if file.get("kind") == "file":
            page = file.findtext("filename")
            page += "" if page.endswith(".html") else ".html"
            found["libs/" + file.findtext("path", "") + file.findtext("name")] = f"api/{page}"
    return found


def is_page(path):
    return path.suffix == ".md" and (path in pages.all_pages())


def relinked(page, text, out, api):
    """Returns the page's text with the site's links, and copies the linked files."""

    def target_on_site(target):
        if "://" in target or target.startswith(("#", "mailto:")):
            return target
        name, hash_, anchor = target.partition("#")
        path = Path(os.path.normpath(page.parent / name))
        if is_page(path):
            return page_name(path) + hash_ + anchor
        if str(path) in api:
            return api[str(path)]
        source = pages.ROOT / path
        if not source.is_file():
            raise SystemExit(f"{page}: {target}: no such file")
        is_document = path.parts[0] == "docs"
        # Browsers display text files, but download unknown types.
        shown = path.relative_to("docs") if is_document else Path("sources") / (str(path) + ".txt")
        (out / shown).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, out / shown)
        return str(shown)

    def in_prose(prose):
        prose = re.sub(r"\[[\w/]*\.md\](?=\((\S+?)[#)])", title, prose)
        return pages.LINK.sub(lambda match: match[1] + target_on_site(match[2]) + match[3], prose)

    def title(match):
        """The page's title, as the text of a link such as [live.md](live.md)."""
        path = pages.ROOT / os.path.normpath(page.parent / match[1])
        return f"[{re.search(r'^# (.*)$', path.read_text(), re.M)[1]}]"

    parts = re.split(r"(^```.*?^```[^\n]*$|`[^`\n]*`)", text, flags=re.S | re.M)
    return "".join(part if i % 2 else in_prose(part) for i, part in enumerate(parts))


def menu(sections):
    """The navigation of mkdocs: the existing pages listed in navigation.yaml, then all others."""

    def entries(listed):
        for entry in listed:
            name, path = next(iter(entry.items())) if isinstance(entry, dict) else (None, entry)
            if path.endswith(".md"):
                rest.discard(Path(path))
                if not (pages.ROOT / path).exists():
                    continue
                path = page_name(Path(path))
            yield {name: path} if name else path

    rest = set(pages.all_pages())
    nav = [{title: list(entries(listed))} for section in sections for title, listed in section.items()]
    if rest:
        nav.append({"More": [page_name(path) for path in sorted(rest)]})
    return nav


def main():
    here, folder = Path(__file__).parent, Path(sys.argv[1])
    out = folder / "docs"
    api = api_pages(out / "api/tags.xml")
    for page in pages.all_pages():
        text = (pages.ROOT / page).read_text()
        (out / page_name(page)).write_text(relinked(page, text, out, api))
    for name in ("site.css", "search_in_files.js"):
        shutil.copyfile(here / name, out / name)
    config = yaml.safe_load((here / "mkdocs.yml").read_text())
    config["theme"]["custom_dir"] = str(here / "theme")
    config["hooks"] = [str(here / "hooks.py")]
    config["nav"] = menu(yaml.safe_load((here / "navigation.yaml").read_text()))
    (folder / "mkdocs.yml").write_text(yaml.safe_dump(config, sort_keys=False))


if __name__ == "__main__":
    main()
