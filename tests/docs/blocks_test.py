"""Every code block is checked by scripts/check-docs or has a reason for its exemption. Also tests the parts of that
script that need no programs."""
import sys
import unittest
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
loader = SourceFileLoader("check_docs", str(ROOT / "scripts/check-docs"))
check_docs = module_from_spec(spec_from_loader("check_docs", loader))
loader.exec_module(check_docs)
pages, shell = check_docs.pages, check_docs.shell


class Blocks(unittest.TestCase):
    def test_every_block_is_checked_or_has_reason(self):
        for page in pages.all_pages():
            text = (ROOT / page).read_text()
            found = list(pages.blocks(page))
            self.assertEqual(2 * len(found), len([line for line in text.splitlines() if line.startswith("```")]), page)
            for block in found:
                where = f"{page}:{block.line}"
                self.assertNotEqual(check_docs.manner(block), "unknown", where)
                self.assertNotEqual(block.notes.get("not run", "why"), None, where)

    def test_file_blocks_match_files(self):
        for page in pages.all_pages():
            for block in pages.blocks(page):
                if check_docs.manner(block) == "file":
                    self.assertIn(block.code.strip(), (ROOT / block.notes["file"]).read_text(), f"{page}:{block.line}")

    def test_comments_before_block_are_notes(self):
        page = Path("docs/any.md")
        text = "<!-- of no block -->\n\nprose\n\n<!-- in order -->\n<!-- with: a=b -->\n```\none\n```\n<!-- given: int i; -->\n```cpp\ntwo\n```\n"
        found = [pages.Block(page, 0, match["language"], match["code"], dict(pages.NOTE.findall(match["notes"])))
                 for match in pages.BLOCK.finditer(text)]
        self.assertEqual([block.notes for block in found], [{"in order": "", "with": "a=b"}, {"given": "int i;"}])


HELP = {"seg": "  -i,--input FILE  -o,--output FILE\n  --preview-all", ("compare", None): "\n  fly  flies", ("compare", "fly"): "  --seed N"}


def help_of(name, subcommand):
    return HELP.get((name, subcommand), HELP.get(name))


class Commands(unittest.TestCase):
    def setUp(self):
        self.flags = shell.Flags(ROOT, {"seg", "compare"}, help_of)

    def test_joins_lines_and_omits_comments(self):
        self.assertEqual(shell.commands("one --a \\\n   two\n\n# all\nthree   # rest\nfour a#b\n"), ["one --a two", "three", "four a#b"])

    def test_finds_each_program_in_line(self):
        self.assertEqual(shell.calls("A=1 seg -i 'a b' && sudo apt install x > log; cd y"),
                         [["seg", "-i", "a b"], ["apt", "install", "x", "log"], ["cd", "y"]])

    def test_accepts_flags_listed_in_help(self):
        for command in ("seg -i a --output=b", "build/release/bin/seg -i a", "compare fly --seed -1", "seg --help", "cmake --anything",
                        "scripts/check-docs --build x"):
            self.assertEqual(self.flags.faults(command), [], command)

    def test_rejects_unknown_flags_programs_commands_and_scripts(self):
        for command in ("seg --inputs a", "seg --preview", "seg -x", "compare walk --seed 1", "compare fly --input a", "segg -i a", "scripts/none",
                        "scripts/check-docs --nothing", "cd a && seg --none", "seg 'open"):
            self.assertEqual(len(self.flags.faults(command)), 1, command)

    def test_finds_commands_and_lines_in_prose(self):
        self.assertEqual(list(shell.inline("one `seg -i a`\n`other -i`\n```\n`seg -x`\n```\n| `build/dev/bin/seg --b` |", ["seg"])),
                         [(1, "seg -i a"), (6, "build/dev/bin/seg --b")])


if __name__ == "__main__":
    unittest.main()
