"""Avoidance campaigns: intervals, stopping, sentences and pages of made-up flights with known answers."""
import csv
import importlib.machinery
import importlib.util
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
SCRIPTS = pathlib.Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
if subprocess.run([sys.executable, "-c", "import jinja2, matplotlib, pandas, scipy, yaml"], check=False,
                  stderr=subprocess.DEVNULL).returncode:
    sys.exit(77)  # skipped
import pandas

import paired

PLAN_FILE = SCRIPTS.parent / "config/campaign/campaign.yaml"
HEADER = ("scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,pose_error,latency_scale,"
          "unknown,emergency_stops,latency_p50_ms,latency_p95_ms,settings,version,air,distance,updates")


def load_report():
    loader = importlib.machinery.SourceFileLoader("avoidance_report", str(SCRIPTS / "avoidance-report"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("avoidance_report", loader))
    loader.exec_module(module)
    return module


def flights(scenario, model, count, failed=(), speed=4, settings="f00d", air="dusty", latency_ms=5, first=1000):
    return [f"{scenario},{first + k},{model},astar,{speed},{'collision' if k in failed else 'success'},0.7,40,11,primitives,"
            f"none,1,optimistic,1,{latency_ms},{2 * latency_ms},{settings},0.1,{air},unbiased,scans" for k in range(count)]


def read(rows):
    with tempfile.TemporaryDirectory() as place:
        file = pathlib.Path(place, "runs.csv")
        file.write_text("\n".join([HEADER, *rows]) + "\n", encoding="utf-8")
        return paired.read_runs(file)


def compare(rows, **changes):
    cell = {**paired.CONDITION, "scenario": "gap", "speed": 4}
    return paired.compare({**paired.read_plan(PLAN_FILE), **changes}, read(rows), cell, "W-RoI", "G-Full")


def test_interval_matches_constrained_likelihood():
    def score_by_search(only_first, only_second, n, delta):
        """The score statistic, with the restricted estimate found by a search of the likelihood."""
        best, q = -math.inf, 0
        for k in range(1, 20000):
            p21 = k / 20000 * (1 - abs(delta)) / 2 + max(0, -delta)
            p12 = p21 + delta
            if min(p12, p21) <= 0 or p12 + p21 >= 1:
                continue
            likelihood = (only_first * math.log(p12) + only_second * math.log(p21) +
                          (n - only_first - only_second) * math.log(1 - p12 - p21))
            if likelihood > best:
                best, q = likelihood, p21
        return (only_first - only_second - n * delta) / math.sqrt(n * (2 * q + delta - delta * delta))

    for only_first, only_second, n in ((12, 2, 50), (3, 9, 200), (1, 4, 44)):
        low, high = paired.interval(only_first, only_second, n, 0.025)
        assert abs(score_by_search(only_first, only_second, n, low) - 1.96) < 0.01
        assert abs(score_by_search(only_first, only_second, n, high) + 1.96) < 0.01
    z2 = 1.959964**2  # without differences, the limit is z^2 / (n + z^2)
    assert abs(paired.interval(0, 0, 100, 0.025)[1] - z2 / (100 + z2)) < 1e-6


def test_verdicts_err_as_rarely_as_planned():
    plan, draw, wrong, trials = paired.read_plan(PLAN_FILE), random.Random(1), 0, 1500
    for _ in range(trials):  # the reference is worse by the margin
        only_first = only_second = courses = 0
        for look, error in zip(plan["looks"], plan["errors"]):
            for _ in range(look - courses):
                at = draw.random()
                only_first += at < 0.03
                only_second += 0.03 <= at < 0.11
            courses = look
            verdict = paired.verdict(*paired.interval(only_first, only_second, look, error), plan["margin"])
            if verdict != paired.UNDECIDED:
                break
        wrong += verdict in (paired.NOT_WORSE, paired.BETTER)
    assert wrong / trials < sum(plan["errors"]) + 0.01, wrong


def test_comparison_ends_at_deciding_look():
    pair = compare(flights("gap", "W-RoI", 200) + flights("gap", "G-Full", 200, failed=range(100, 200)))
    assert (pair["courses"], pair["verdict"], pair["only_first"]) == (100, paired.NOT_WORSE, 0), pair
    pair = compare(flights("gap", "W-RoI", 50) + flights("gap", "G-Full", 50, failed=range(30)))
    assert (pair["courses"], pair["verdict"]) == (50, paired.BETTER), pair
    pair = compare(flights("gap", "W-RoI", 50, failed=range(30)) + flights("gap", "G-Full", 50))
    assert pair["verdict"] == paired.WORSE, pair
    half = [k for k in range(400) if k % 4 < 2]
    pair = compare(flights("gap", "W-RoI", 400, failed=range(1, 400, 2)) + flights("gap", "G-Full", 400, failed=half))
    assert (pair["courses"], pair["verdict"]) == (400, paired.UNDECIDED), pair


def test_fewer_than_50_shared_courses_decide_nothing():
    pair = compare(flights("gap", "W-RoI", 49) + flights("gap", "G-Full", 400, failed=range(49)))
    assert pair["verdict"] == paired.TOO_FEW and pair["courses"] == 0, pair
    pair = compare(flights("gap", "W-RoI", 49) + flights("gap", "G-Full", 49, failed=range(49)), looks=[49])
    assert pair["verdict"] == paired.TOO_FEW and pair["courses"] == 49, pair
    for other in ({"first": 1030}, {"air": "clear"}):
        pair = compare(flights("gap", "W-RoI", 60) + flights("gap", "G-Full", 60, failed=range(60), **other))
        assert pair["verdict"] == paired.TOO_FEW, pair


def test_interrupted_comparison_and_other_seeds_decide_nothing():
    pair = compare(flights("gap", "W-RoI", 99) + flights("gap", "G-Full", 99))
    assert (pair["courses"], pair["verdict"]) == (50, paired.TOO_FEW), pair
    pair = compare(flights("gap", "W-RoI", 60, first=500) + flights("gap", "G-Full", 60, failed=range(60), first=500) +
                   flights("gap", "W-RoI", 100) + flights("gap", "G-Full", 100))
    assert (pair["courses"], pair["verdict"], pair["second_success"]) == (100, paired.NOT_WORSE, 100), pair


def test_next_look_flies_undecided_models_only():
    plan = paired.read_plan(PLAN_FILE)
    plan["questions"] = {"static": {"reference": "W-RoI", "models": ["W-Full", "G-Full"],
                                    "cells": [{**paired.CONDITION, "scenario": "gap", "speed": 4}]}}
    (cell, models, courses), = paired.next_flights(plan, None)
    assert (models, courses) == (["W-RoI", "W-Full", "G-Full"], 50)
    words = paired.command(plan, cell, models, courses)
    assert words[words.index("--seeds") + 1] == "1000-1049" and words[words.index("--air") + 1] == "dusty", words
    rows = flights("gap", "W-RoI", 50) + flights("gap", "W-Full", 50, failed=range(30)) + flights("gap", "G-Full", 50)
    (_, models, courses), = paired.next_flights(plan, read(rows))
    assert (models, courses) == (["W-RoI", "G-Full"], 100)
    done = flights("gap", "W-RoI", 100) + flights("gap", "W-Full", 50, failed=range(30)) + flights("gap", "G-Full", 100)
    assert not paired.next_flights(plan, read(done))


def pairs(*rows):
    table = pandas.DataFrame([dict(zip(("scenario", "first", "second", "verdict", "first_success", "second_success"), row),
                                   courses=100) for row in rows])
    table["only_first"] = (table["first_success"] - table["second_success"]).clip(lower=0)
    table["only_second"] = (table["second_success"] - table["first_success"]).clip(lower=0)
    return table


def test_sentences_follow_verdicts():
    report = load_report()
    equal = ("gap", "W-RoI", "G-Full", paired.NOT_WORSE, 98, 97)
    worse = ("wires", "W-RoI", "D-Full", paired.WORSE, 30, 60)
    also = ("wires", "W-RoI", "G-Full", paired.WORSE, 30, 42)
    window = ("gap", "W-RoI", "W-Full", paired.WORSE, 30, 60)
    open_ = ("orchard", "W-RoI", "G-Full", paired.UNDECIDED, 80, 82)
    few = ("orchard", "W-RoI", "G-Full", paired.TOO_FEW, 0, 0)
    better = ("gap", "W-RoI", "O-Full-0.4", paired.BETTER, 98, 50)

    def said(*rows):
        return report.maps_help(pairs(*rows), "At 4 m/s").removeprefix("At 4 m/s, compared with the RoI window, ")

    assert said(equal, better, window) == ("no map is better by 5 points in `gap`; a map succeeds less often in `gap` (OctoMap by "
                                           "48.0 points).")
    assert said(better, window) == "a map succeeds less often in `gap` (every map by 48.0 points)."
    assert said(worse, also, equal) == ("a map succeeds more often in `wires` (every map by up to 30.0 points); no map is better by "
                                        "5 points in `gap`.")
    assert said(worse, open_) == ("a map succeeds more often in `wires` (every map by 30.0 points); no map was shown to be "
                                  "better in `orchard`.")
    for no_conclusion in ((few,), (equal, few), (worse, few), (window,)):
        assert said(*no_conclusion) == "At 4 m/s: too few flights."
    for verdict, text in ((paired.BETTER, "raises the"), (paired.WORSE, "lowers the"), (paired.NOT_WORSE, "does not lower the"),
                          (paired.UNDECIDED, "was not shown to change the"), (paired.TOO_FEW, ": too few flights")):
        said_of = report.tracking_helps(pairs(("movers", "W-RoI+motion", "W-RoI", verdict, 94, 56)), "At 8 m/s")
        assert f"At 8 m/s, tracking{'' if text[0] == ':' else ' '}{text}" in said_of, verdict


def test_cost_sentences_follow_table():
    report = load_report()
    cost = pandas.DataFrame({"latency_p50_ms": [5.3, 16.5, 5.8], "update_end": [1, 6, 3.0], "memory_end": [1.5, 90.7, 3.7]},
                            index=["W-RoI", "G-Full", "R-Full-0.2"])
    assert report.cost_answers(cost) == [
        "From scan to command, the RoI window takes a median of 5.3 ms, the maps 5.8 ms (rolling grid) to 16.5 ms (occupancy "
        "grid).",
        "After 1 km, an update takes 1.0 ms and 1.5 MB for the RoI window, 3.0 ms and 3.7 MB for maps of a box around the "
        "vehicle, 6.0 ms and 90.7 MB for maps of the whole flight."]
    assert report.cost_answers(cost.drop("W-RoI")) == ["Not measured."]
    assert report.cost_answers(cost.assign(memory_end=float("nan")))[1] == "Memory: not measured."


def test_second_campaign_is_judged():
    for verdict, difference, low, high, agrees, contradicts in (
            (paired.BETTER, 0.1, -0.1, 0.3, True, False), (paired.BETTER, -0.2, -0.4, -0.01, False, True),
            (paired.WORSE, 0.2, 0.1, 0.3, False, True), (paired.NOT_WORSE, -0.1, -0.2, -0.02, False, False), (paired.NOT_WORSE, -0.2, -0.3, -0.06, False, True)):
        assert paired.agrees(verdict, difference, 0.05) == agrees
        assert paired.contradicts(verdict, low, high, 0.05) == contradicts


def test_mixed_revisions_are_refused():
    message = ""
    try:
        read(flights("gap", "W-RoI", 50) + flights("gap", "G-Full", 50, settings="beef"))
    except ValueError as error:
        message = str(error)
    assert "several revisions" in message


def test_page_shows_verdicts_and_intervals():
    with tempfile.TemporaryDirectory() as place:
        folder, out = pathlib.Path(place, "campaign"), pathlib.Path(place, "out")
        folder.mkdir()
        rows = flights("gap", "W-RoI", 100) + flights("gap", "G-Full", 100, failed=[99], latency_ms=20)
        (folder / "runs.csv").write_text("\n".join([HEADER, *rows]) + "\n", encoding="utf-8")
        (folder / "campaign.json").write_text(json.dumps({"profile": {"machine": "a computer"}}), encoding="utf-8")
        (folder / "cost.csv").write_text("model,path_m,bytes,update_ms\nW-RoI,20,1e6,1\nW-RoI,1000,1.5e6,1.2\nG-Full,20,3e6,6\n"
                                         "G-Full,1000,9e7,7\n", encoding="utf-8")
        subprocess.run([SCRIPTS / "avoidance-report", folder, "-o", out], check=True, stdout=subprocess.DEVNULL)
        page = (out / "avoidance.md").read_text(encoding="utf-8")
        assert "|`gap`, 4 m/s|100.0|too few flights|-1.0|too few flights|" in page, page
        assert "|occupancy grid|6.0/7.0|3.0/90.0|20.0/40.0|25.0|" in page
        assert "At 4 m/s: too few flights." in page and "nan" not in page
        with open(out / "avoidance/pairs.csv", encoding="utf-8", newline="") as table:
            pair = next(row for row in csv.DictReader(table) if row["scenario"] == "gap" and row["second"] == "G-Full")
        assert (pair["only_first"], pair["verdict"]) == ("1", paired.NOT_WORSE), pair
        assert -0.05 < float(pair["low"]) < 0 < float(pair["high"]), pair
    done = subprocess.run([SCRIPTS / "avoidance-report", "/none"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "/none/runs.csv: No such file" in done.stderr, done


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
