"""Parses Markdown pages for the site and the tests of the documents: headings, links, code blocks."""
import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def all_pages():
    """All pages for readers, relative to the project's root."""
    pages = [Path(name) for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "rawlogs/README.md")]
    return pages + sorted(path.relative_to(ROOT) for path in (ROOT / "docs").glob("*.md"))


def slug(heading):
    """The anchor of a heading, on GitHub and on the site."""
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[`*]|<[^>]*>|\\(?=[\W_])", "", text).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def without_code(text):
    """The text with empty lines in place of code and comments."""
    blank = lambda match: "\n" * match[0].count("\n")
    text = re.sub(r"^```.*?^```[^\n]*$", blank, text, flags=re.S | re.M)
    return re.sub(r"<!--.*?-->", blank, text, flags=re.S)


def anchors(text):
    """The anchors of all headings; repeated anchors are numbered."""
    seen, found = {}, set()
    for heading in re.findall(r"^#{1,6} +(.*?)#* *$", without_code(text), re.M):
        name = slug(heading)
        count = seen.get(name, 0)
        seen[name] = count + 1
        found.add(f"{name}-{count}" if count else name)
    return found | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


LINK = re.compile(r"(\]\()([^)\s]+)((?:\s+\"[^\"]*\")?\))")
PICTURE = re.compile(r"!\[[^][]*" + LINK.pattern)


def links(text):
    """Yields line (from 1), target, and whether it is a picture, for each link."""
    prose = re.sub(r"`[^`\n]*`", lambda match: " " * len(match[0]), without_code(text))
    pictures = {match.start(2) for match in PICTURE.finditer(prose)}
    for match in LINK.finditer(prose):
        yield prose.count("\n", 0, match.start()) + 1, match[2], match.start(2) in pictures


@dataclass
class Block:
    """A fenced code block, and the comments before it, which say how it is checked."""

    page: Path
    line: int  # of the fence, from 1
    language: str
    code: str
    notes: dict = field(default_factory=dict)


NOTE = re.compile(r"<!-- *([a-z ]+?)(?::\s*(.*?))?\s*-->", re.S)
BLOCK = re.compile(r"(?P<notes>(?:^<!--(?:(?!-->).)*-->\n+)*)^```(?P<language>[\w+]*)\n(?P<code>.*?)^```[^\n]*$", re.S | re.M)


def blocks(page):
    text = (ROOT / page).read_text()
    for match in BLOCK.finditer(text):
        line = text.count("\n", 0, match.start("language")) + 1
        yield Block(page, line, match["language"], match["code"], dict(NOTE.findall(match["notes"])))
