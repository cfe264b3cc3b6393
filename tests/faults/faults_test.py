#!/usr/bin/env python3
"""Makes the n-th system call (strace) of a program fail, or sends a signal at a system call, and checks the outcome:
exit code 0, 1 or 2 within TIMEOUT_S; each output complete or unchanged, and complete if the exit code is 0; no other
files left except readable .partial files; a second run succeeds.

    faults_test.py CASE --build DIR --calls rename,write,signals [--every K]

Exit codes: 0 passed, 1 failed, 2 cannot run: strace is missing or not permitted to trace."""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
ERRORS = {"write": ["ENOSPC", "EIO"], "rename": ["EACCES", "EIO"], "renameat2": ["EINVAL", "EIO"], "fsync": ["EIO"],
          "clone3": ["EAGAIN"], "pipe2": ["EMFILE"]}
TIMEOUT_S = 30
SIGNALS = ["SIGINT", "SIGTERM", "SIGHUP", "SIGKILL"]


def run(command, folder, timeout=None):
    """Like subprocess.run(), but kills all processes started by the command."""
    process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, start_new_session=True, text=True, errors="replace")
    try:
        out, err = process.communicate(timeout=timeout)
        return subprocess.CompletedProcess(command, process.returncode, out, err)
    finally:
        subprocess.run(["kill", "-KILL", "--", f"-{process.pid}"], stderr=subprocess.DEVNULL, check=False)


def must(command, folder):
    done = run(command, folder)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: {done.stderr}")


def content(path):
    """The bytes of a file, or of all files of a folder by name; None if missing."""
    if path.is_dir():
        return {str(file.relative_to(path)): file.read_bytes() for file in sorted(path.rglob("*")) if file.is_file()}
    return path.read_bytes() if path.exists() else None


# How to compare outputs that contain measured times or pictures.

def counts(value):
    return {key: len(item) if isinstance(item, list) else item for key, item in value.items()
            if isinstance(item, (int, list))}


def same_json(found, expected):
    try:
        return counts(json.loads(found or b"")) == counts(json.loads(expected))
    except ValueError:
        return False


def same_names(found, expected):
    return isinstance(found, dict) and found.keys() == expected.keys() and all(found.values())


@dataclass
class Case:
    """A run that replaces the outputs of an earlier run with other arguments."""
    program: Path
    arguments: list
    before: list  # additional arguments of the earlier run
    after: list
    outputs: list
    same: dict = field(default_factory=dict)  # comparison by output; default: of the bytes


def conversion(bin_folder, folder):
    shutil.copy(SOURCE / "rawlogs/poles_and_wall.rawlog", folder / "in.rawlog")
    (folder / "still.txt").write_text("1 0 0 0 0 1 0 0 0 0 1 1\n" * 10)  # a pose per scan
    return Case(bin_folder / "rawlog-segment",
                ["-i", "in.rawlog", "--from", "3", "-o", "out.rawlog", "--kitti", "scans", "--clouds", "clouds",
                 "--mcap", "out.mcap", "--stats", "out.json", "--jobs", "2", "--octomap", "map.bt", "--poses",
                 "still.txt"], ["--to", "5"], ["--to", "9"],
                ["out.rawlog", "scans", "clouds", "out.mcap", "out.json", "map.bt"], {"out.json": same_json})


SCANS = ["--scenario", "orchard", "--altitude", "3", "--scans", "2"]


def simulation(bin_folder, _):
    return Case(bin_folder / "rawlog-simulate", [*SCANS, "-o", "out.rawlog", "--kitti", "truth", "--poses", "out.txt"],
                ["--seed", "7"], ["--seed", "8"], ["out.rawlog", "truth", "out.txt"])


def evaluation(bin_folder, folder):
    must([bin_folder / "rawlog-simulate", *SCANS, "--seed", "7", "--kitti", "scans"], folder)
    return Case(bin_folder / "segmentation-evaluate",
                ["-i", "scans", "--camera", SOURCE / "config/camera_forward.yaml", "--json", "out.json", "--charts",
                 "charts", "--overlay", "overlays"], ["--bootstrap", "20"], ["--bootstrap", "30"],
                ["out.json", "charts", "overlays"],
                {"charts": same_names, "overlays": same_names, "out.json": same_json})


CASES = {"conversion": conversion, "simulation": simulation, "evaluation": evaluation}


class Injector:
    def __init__(self, make_case, build):
        self.folder = tempfile.TemporaryDirectory(prefix="hagen-faults-")
        self.old = Path(self.folder.name) / "old"
        self.old.mkdir()
        self.case = make_case(build / "bin", self.old)
        self.inputs = {path.name for path in self.old.iterdir()}
        must([self.case.program, *self.case.arguments, *self.case.before], self.old)
        self.command = [self.case.program, *self.case.arguments, *self.case.after, "--overwrite"]
        new = self.copy()
        must(self.command, new)
        self.before, self.after = self.outputs(self.old), self.outputs(new)

    def copy(self):
        return Path(shutil.copytree(self.old, tempfile.mkdtemp(dir=self.folder.name), dirs_exist_ok=True))

    def outputs(self, folder):
        return {name: content(folder / name) for name in self.case.outputs}

    def is_complete(self, name, found):
        return self.case.same.get(name, lambda a, b: a == b)(found, self.after[name])

    def faults(self, calls, every):
        log, counts = Path(self.folder.name) / "log", dict.fromkeys(ERRORS, 0)
        must(["strace", "-f", "-qq", "-o", log, "-e", "trace=" + ",".join(ERRORS), *self.command], self.copy())
        calls_of_threads = Counter(re.findall(r"^(\d+) +(\w+)\(", log.read_text(errors="replace"), re.M))
        for (_, call), count in calls_of_threads.items():  # strace counts per thread
            counts[call] = max(counts[call], count)
        found = [f"{call}:error={error}:when={n}" for call in calls if call in ERRORS for error in ERRORS[call]
                 for n in range(1, counts[call] + 1)]
        if "signals" in calls:
            found += [f"write:signal={name}:when={n}" for name in SIGNALS for n in range(1, counts["write"] + 1)]
        return found[::every]

    def try_fault(self, fault):
        """Returns the errors."""
        folder = self.copy()
        try:
            trace = ["-e", "trace=" + fault.partition(":")[0], "-e", "inject=" + fault]
            ended = run(["strace", "-f", "-qq", "-o", "/dev/null", *trace, *self.command], folder, TIMEOUT_S)
            return self.wrong(fault, folder, ended)
        except subprocess.TimeoutExpired:
            return [f"takes more than {TIMEOUT_S} s"]
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def wrong(self, fault, folder, ended):
        code, found, wrong = ended.returncode, self.outputs(folder), []
        # A signal may end the program before anything is written.
        is_ended = "SIGKILL" in fault or "signal=" in fault and code < 0 and found == self.before
        if code not in (0, 1, 2) and not is_ended:
            wrong.append(f"exit code {code}: {ended.stderr[-200:]}")
        elif code != 0 and not ended.stderr.strip() and not is_ended and "write" not in fault:
            wrong.append(f"exit code {code} without a message")
        for name in self.case.outputs:
            if not self.is_complete(name, found[name]):
                if found[name] != self.before[name]:
                    wrong.append(f"{name} is neither the old nor the new version")
                elif code == 0:
                    wrong.append(f"exit code 0, but {name} was not written")
        left = {path.name for path in folder.iterdir()} - self.inputs - set(self.case.outputs)
        partial = {name for name in left if ".partial" in name}
        if left - partial and "SIGKILL" not in fault:
            wrong.append(f"left behind: {sorted(left - partial)}")
        for name in partial:
            if name.endswith(".rawlog") and run(["gzip", "-t", "-S", ".rawlog", name], folder).returncode != 0:
                wrong.append(f"{name} is not readable")
        again = run(self.command, folder, TIMEOUT_S)
        if again.returncode != 0:
            wrong.append(f"the second run fails: {again.stderr[-200:]}")
        elif not all(self.is_complete(name, output) for name, output in self.outputs(folder).items()):
            wrong.append("the second run writes other outputs")
        return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--build", type=Path, default=SOURCE / "build/dev")
    parser.add_argument("--calls", required=True)
    parser.add_argument("--every", type=int, default=1, metavar="K", help="try every K-th fault")
    flags = parser.parse_args()
    if not shutil.which("strace") or run(["strace", "-qq", "-o", "/dev/null", "true"], "/").returncode != 0:
        raise RuntimeError("strace is missing or not permitted to trace")
    injector = Injector(CASES[flags.case], flags.build.resolve())
    faults, failed = injector.faults(flags.calls.split(","), flags.every), 0
    for fault in faults:
        wrong = injector.try_fault(fault)
        failed += bool(wrong)
        for text in wrong:
            print(f"{flags.case}: {fault}: {text}", flush=True)
    print(f"{flags.case}: {len(faults)} faults injected, {failed} failed")
    return 1 if failed or not faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        print(f"faults_test: {error}", file=sys.stderr)
        sys.exit(2)
