"""scripts/explain-collisions on a made-up campaign whose further flights are all there."""
import csv
import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts/explain-collisions"
HEADER = ["scenario", "seed", "model", "guidance", "speed", "outcome", "planner", "pose_error", "latency_scale",
          "unknown", "air", "distance"]


def rows(seed, outcomes, speed="10"):
    """One course: (model, latency scale) -> outcome."""
    return [["gap", str(seed), model, "astar", speed, outcome, "primitives", "none", scale, "optimistic", "dusty",
             "unbiased"] for (model, scale), outcome in outcomes.items()]


def outcomes(**changed):
    """The window collides, and all that would explain it does, too."""
    of = {("W-RoI", "1"): "collision", ("oracle", "1"): "success", ("W-RoI", "0.1"): "collision",
          ("W-RoI+motion", "1"): "timeout", ("W-Full", "1"): "timeout", ("G-Full", "1"): "collision"}
    names = {"oracle": ("oracle", "1"), "tenth": ("W-RoI", "0.1"), "motion": ("W-RoI+motion", "1"),
             "full": ("W-Full", "1"), "grid": ("G-Full", "1"), "window": ("W-RoI", "1")}
    of.update({names[name]: outcome for name, outcome in changed.items()})
    return of


def write(folder, table):
    folder.mkdir()
    with open(folder / "runs.csv", "w", encoding="utf-8", newline="") as out:
        csv.writer(out).writerows([HEADER, *table])


def explain(folder, table):
    write(folder, [row for row in table if row[8] == "1"])
    write(folder.with_name(folder.name + "-again"), [row for row in table if row[8] != "1"])
    return subprocess.run([SCRIPT, folder], capture_output=True, text=True, check=False,
                          env={"PATH": "/usr/bin:/bin", "HAGEN_OCTOMAP_COMPARE": "/bin/false"})


with tempfile.TemporaryDirectory() as place:
    place = pathlib.Path(place)
    made_up = (rows(1, outcomes(oracle="collision")) + rows(2, outcomes(tenth="success")) +
               rows(3, outcomes(motion="success")) + rows(4, outcomes(motion="success", full="success")) +
               rows(5, outcomes(full="success")) + rows(6, outcomes(grid="success")) + rows(7, outcomes()) +
               rows(8, outcomes(window="success")) + rows(9, outcomes(), speed="8"))
    done = explain(place / "campaign", made_up)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[2] == "| `gap` | 10 | `W-RoI` | 7 | 1 | 1 | 2 | 1 | 1 | 1 |", done.stdout
    assert len(done.stdout.splitlines()) == 3, done.stdout

    missing = explain(place / "unflown", [row for row in made_up if row[2] != "oracle"])
    assert missing.returncode != 0 and missing.stdout == "", "what is missing is flown, and that fails here"

    HEADER.append("settings")
    mixed = explain(place / "mixed", [row + ["old" if row[8] == "1" else "new"] for row in made_up])
    assert mixed.returncode == 1 and "other settings" in mixed.stderr and mixed.stdout == "", mixed.stderr

    nowhere = subprocess.run([SCRIPT, place / "nowhere"], capture_output=True, text=True, check=False)
    assert nowhere.returncode == 1 and "nowhere/runs.csv: No such file" in nowhere.stderr, nowhere.stderr
