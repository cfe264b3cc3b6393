"""Compares the table of limits in docs/reliability.md with the constants in the code."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
UNITS = {"KiB": 2**10, "MiB": 2**20, "GiB": 2**30, "million": 1e6}


def rows(page):
    """(what, limit, constants, file name) of each row."""
    table = page.partition("## Limits")[2].partition("\n## ")[0]
    for line in re.findall(r"^\| (?!-|quantity )(.*) \|$", table, re.M):
        what, limit, _, declared = line.split(" | ")
        *constants, file = re.findall(r"`(.*?)`", declared)
        yield what, limit, constants, file


def values_of_page(limit):
    """The numbers of a limit such as '64 MiB plus 32 bytes', except explanations in parentheses."""
    text = re.sub(r"\(.*?\)", "", limit).replace("half", "2").replace("2^32", str(2**32))
    for number, unit in re.findall(r"(-?\d[\d.]*(?:e\d+)?) ?(\w*)", text):
        yield float(number) * UNITS.get(unit, 1), unit


def values_of_code(code, constant):
    """The numbers between the constant's name and the end of its line or statement."""
    text = " ".join(re.findall(re.escape(constant) + r"(?!\w)([^;\n]*)", re.sub(r"//.*", "", code)))
    numbers = re.findall(r"(?<![\w.])(-?\d[\d'.]*(?:e\d+)?)\}?(?: << (\d+))?", text)
    return {float(number.replace("'", "")) * 2 ** int(shift or 0) for number, shift in numbers}


class Limits(unittest.TestCase):
    def test_code_declares_documented_limits(self):
        found = list(rows((ROOT / "docs/reliability.md").read_text()))
        self.assertGreater(len(found), 20)
        for what, limit, constants, file in found:
            code = "\n".join(path.read_text() for path in (ROOT / "libs").rglob(file))
            declared = set().union(*(values_of_code(code, constant) for constant in constants))
            for value, unit in values_of_page(limit):
                with self.subTest(what=what, limit=limit, file=file):
                    self.assertTrue(value in declared or unit == "s" and value * 1000 in declared, declared)


if __name__ == "__main__":
    unittest.main()
