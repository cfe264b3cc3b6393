"""Paired comparisons of an avoidance campaign, and the rules that decide when one ends.

A comparison is a cell (scenario, speed and condition) and two models: the question's reference and
another. Both fly the same courses. After each look of the plan, an interval of the difference of
their success rates decides; each look spends its part of the error. Bounds add up, so a verdict is
wrong with at most the sum of these errors on either side.
"""
import math

import pandas
import yaml
from scipy.optimize import brentq
from scipy.stats import norm

CONDITION = {"guidance": "astar", "planner": "primitives", "pose_error": "none", "latency_scale": 1.0,
             "unknown": "optimistic", "air": "dusty", "distance": "unbiased", "updates": "scans"}
CELL = ["scenario", "speed", *CONDITION]
BETTER, WORSE, NOT_WORSE, UNDECIDED, TOO_FEW = "better", "worse", "not worse", "undecided", "too few flights"
MIN_COURSES = 50  # for any verdict


def read_plan(file):
    """The plan; each question has cells with all columns of CELL."""
    with open(file, encoding="utf-8") as text:
        plan = yaml.safe_load(text)
    for question in plan["questions"].values():
        question["cells"] = [{**CONDITION, **cell} for cell in question["cells"]]
    return plan


def read_runs(file):
    """The table of flights. Refuses tables of several revisions or latency profiles."""
    runs = pandas.read_csv(file, dtype={"settings": str})
    runs["latency_scale"] = runs["latency_scale"].astype(float)
    if runs["settings"].nunique() > 1:
        raise ValueError(f"{file}: flights of several revisions or latency profiles; fly them again in one folder")
    runs["succeeds"] = runs["outcome"] == "success"
    return runs


def interval(only_first, only_second, courses, error):
    """Tango's score interval of a difference of paired success rates, with this error per side.

    Tango, Statistics in Medicine 17 (1998) 891-908."""
    z, n = norm.isf(error), courses

    def score(delta):
        b = -only_first - only_second + (2 * n - only_first + only_second) * delta
        c = -only_second * delta * (1 - delta)
        q = (math.sqrt(max(b * b - 8 * n * c, 0)) - b) / (4 * n)
        spread = math.sqrt(max(n * (2 * q + delta * (1 - delta)), 1e-12))
        return (only_first - only_second - n * delta) / spread

    end = 1 - 1e-9
    low = brentq(lambda delta: score(delta) - z, -end, end) if score(-end) > z else -1.0
    high = brentq(lambda delta: score(delta) + z, -end, end) if score(end) < -z else 1.0
    return low, high


def verdict(low, high, margin):
    """The verdict on the reference by an interval of (reference - other)."""
    if low > 0:
        return BETTER
    if high < 0:
        return WORSE
    return NOT_WORSE if low > -margin else UNDECIDED


def flown(runs, cell, model):
    """Success by seed of a model in a cell."""
    keep = runs["model"] == model
    for column in CELL:
        keep &= runs[column] == cell[column]
    return runs[keep].set_index("seed")["succeeds"]


def compare(plan, runs, cell, first, second):
    """The comparison up to the look that decides it, as a dictionary. Before the last look, it is
    decided or has too few flights."""
    a, b = flown(runs, cell, first), flown(runs, cell, second)
    shared = a.index.intersection(b.index)
    result = {"courses": 0, "verdict": TOO_FEW}
    for courses, error in zip(plan["looks"], plan["errors"]):
        seeds = [seed for seed in shared if plan["seeds"] <= seed < plan["seeds"] + courses]
        if len(seeds) < courses:
            break
        one, two = a[seeds], b[seeds]
        only_first, only_second = int((one & ~two).sum()), int((two & ~one).sum())
        low, high = interval(only_first, only_second, courses, error)
        result = {"courses": courses, "first_success": int(one.sum()), "second_success": int(two.sum()),
                  "only_first": only_first, "only_second": only_second, "low": low, "high": high,
                  "error_per_side": error, "verdict": verdict(low, high, plan["margin"])}
        if courses < MIN_COURSES:
            result["verdict"] = TOO_FEW
        elif result["verdict"] != UNDECIDED:
            break
    if result["verdict"] == UNDECIDED and result["courses"] < plan["looks"][-1]:
        result["verdict"] = TOO_FEW
    return {**cell, "first": first, "second": second, **result}


def compare_all(plan, runs):
    """All comparisons of a plan, by question."""
    return pandas.DataFrame([
        {"question": name, **compare(plan, runs, cell, question["reference"], model)}
        for name, question in plan["questions"].items() for cell in question["cells"]
        for model in question["models"]])


def next_flights(plan, runs):
    """The flights of the next look: (cell, models, number of courses), without those of decided comparisons.

    `runs` is None before the first flight."""
    if runs is None:
        runs = pandas.DataFrame(columns=[*CELL, "model", "seed", "succeeds"])
    due = []
    for question in plan["questions"].values():
        first, ceiling = question["reference"], question.get("ceiling")
        for cell in question["cells"]:
            waiting = {}
            for second in question["models"]:
                pair = compare(plan, runs, cell, first, second)
                left = [courses for courses in plan["looks"] if courses > pair["courses"]]
                if pair["verdict"] == TOO_FEW and left:
                    waiting.setdefault(left[0], []).append(second)
            if ceiling and len(flown(runs, cell, ceiling)) < plan["ceiling_courses"]:
                due.append((cell, [ceiling], plan["ceiling_courses"]))
            due += [(cell, [first, *models], courses) for courses, models in waiting.items()]
    return due


def command(plan, cell, models, courses):
    """The arguments of `octomap-compare` for these flights, without output."""
    words = ["closedloop", "-q", "--models", ",".join(models), "--seeds", f"{plan['seeds']}-{plan['seeds'] + courses - 1}"]
    for column in CELL:
        words += ["--" + column.replace("_", "-"), str(cell[column]).replace("brake_known", "brake-known")]
    return words + (["--profile", plan["profile"]] if plan["profile"] else [])


def contradicts(verdict_before, low, high, margin):
    """Whether the interval of a second campaign excludes a verdict."""
    return {BETTER: high <= 0, WORSE: low >= 0, NOT_WORSE: high <= -margin}[verdict_before]


def agrees(verdict_before, difference, margin):
    """Whether the difference in a second campaign has the sign, or the size, of a verdict."""
    return {BETTER: difference > 0, WORSE: difference < 0, NOT_WORSE: difference > -margin}[verdict_before]
