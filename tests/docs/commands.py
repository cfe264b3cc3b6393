"""Parses and checks the commands in the documentation: their programs and flags."""
import re
import shlex
from pathlib import Path

# Third-party programs, whose flags are not checked.
FOREIGN = {"cmake", "ctest", "apt", "cd", "cp", "echo", "export", "install", "journalctl", "mkdir", "npm", "pip", "pkg-config",
           "python3", "snakemake", "systemctl", "tar", "tee", "doxygen", "man", "git"}


def commands(code):
    """The commands of a block, one per logical line, without comments."""
    lines = []
    for line in re.sub(r"\s*\\\n\s*", " ", code).splitlines():
        line = re.sub(r"(^|\s)#.*$", "", line).strip()
        if line:
            lines.append(line)
    return lines


def calls(command):
    """The programs that a command calls, each with its arguments."""
    lexer = shlex.shlex(command, posix=True, punctuation_chars="&;|<>()")
    lexer.whitespace_split = True
    found, current = [], []
    for token in list(lexer) + [";"]:
        if re.fullmatch(r"[&;|()]+", token):
            if current:
                found.append(current)
            current = []
        elif not re.fullmatch(r"[<>]+", token):
            current.append(token)
    return [call for call in map(without_setting, found) if call]


def without_setting(call):
    """A call without variable assignments and sudo."""
    while call and (re.match(r"[A-Z_]+=", call[0]) or call[0] == "sudo"):
        call = call[1:]
    return call


def flags(arguments):
    """Flags without their values; ignores a lone dash and negative numbers."""
    return [argument.partition("=")[0] for argument in arguments if re.match(r"--?[a-zA-Z]", argument)]


class Flags:
    """Checks the flags of commands against the programs' own help."""

    def __init__(self, root, programs, help_of):
        """`programs`: our programs; `help_of(name, subcommand)`: output of --help, None if there is no such subcommand."""
        self.root, self.programs, self.help_of = Path(root), set(programs), help_of

    def faults(self, command):
        try:
            return [fault for call in calls(command) for fault in self.of_call(call)]
        except ValueError as error:
            return [f"{command}: {error}"]

    def of_call(self, call):
        name = Path(call[0]).name
        if name == "source":
            return []
        if call[0].startswith("scripts/") or name == "python_speed.py":
            script = self.root / call[0]
            if not script.exists():
                return [f"{call[0]}: no such script"]
            text = script.read_text()
            if call[0] == "scripts/test":  # passes its arguments on
                text += self.help_of("ctest", None)
        elif name.endswith("-benchmarks"):  # Google Benchmark has no --help
            text = "--benchmark_"
        elif name in self.programs:
            words = [argument for argument in call[1:2] if not argument.startswith("-")]
            text = self.help_of(name, words[0] if words else None)
            if text is None:
                return [f"{name} {words[0]}: no such command"]
        elif name in FOREIGN or call[0].startswith("build/"):
            return []
        else:
            return [f"{name}: neither ours nor a known program"]
        return [f"{name}: no flag {flag}" for flag in flags(call[1:])
                if not flag.startswith("--benchmark_") and flag not in ("--help", "-h")
                and not re.search(r"(?<![\w-])" + re.escape(flag) + r"(?![\w-])", text)]


def inline(text, programs):
    """Line and command of each `program --flag` in prose and tables."""
    names = "|".join(map(re.escape, sorted(programs)))
    pattern = re.compile(r"`((?:build/\w+/bin/)?(?:%s)(?: [^`\n]*)?)`" % names)
    for match in pattern.finditer(re.sub(r"^```.*?^```[^\n]*$", lambda m: "\n" * m[0].count("\n"), text, flags=re.S | re.M)):
        yield 1 + match.string.count("\n", 0, match.start()), match[1]
