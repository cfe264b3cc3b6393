"""Tables of measurements in documents."""
import csv


def table(lines):
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    text = ["| " + " | ".join(c.ljust(w) for c, w in zip(line, widths)) + " |" for line in lines]
    text.insert(1, "|" + "|".join("-" * (w + 2) for w in widths) + "|")
    return "\n".join(text) + "\n"


def write(page, tables):
    """Replaces the tables marked in the page and writes the others to CSV files."""
    text = page.read_text()
    for name, lines in tables.items():
        start, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
        if start in text and end in text:
            text = text[:text.index(start) + len(start)] + "\n" + table(lines) + "\n" + text[text.index(end):]
            continue
        page.with_suffix("").mkdir(exist_ok=True)
        with open(page.with_suffix("") / f"{name}.csv", "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(lines)
    page.write_text(text)
