#!/usr/bin/env python3
"""Writes a folder as `octomap-compare closedloop` leaves it, with runs that nobody flew: enough of
them to fill every table and chart of a report. Usage: sample_runs.py DIR"""
import json
import pathlib
import random
import sys

HEADER = (
    "scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,pose_error,"
    "latency_scale,unknown,oracle_path_m,first_reaction_m,rms_jerk_m_s3,scans,dropped_scans,"
    "emergency_stops,latency_p50_ms,latency_p95_ms,latency_max_ms,settings,version,air,distance")
SCENARIOS = ["forest-0.02", "forest-0.05", "forest-0.10", "gap", "movers", "orchard", "street",
             "terrain", "u-trap", "wires"]
UPDATE_MS = {"W-RoI": 0.9, "W-Full": 2.5, "G-Full": 14, "O-Full-0.4": 20, "O-Full-0.2": 90}


def row(scenario, seed, model, guidance, speed):
    draw = random.Random(f"{scenario} {seed} {model} {guidance} {speed}")
    course = random.Random(f"{scenario} {seed}")
    fails = 0.01 + 0.003 * speed + (0.04 if model == "O-Full-0.2" else 0)
    if scenario == "wires" and model.startswith("O-"):
        fails += 0.2
    if scenario == "forest-0.10":
        fails += 0.02 * max(0, speed - 4)
    if scenario == "u-trap" and guidance == "straight":
        fails = 0.9
    lost = draw.random() < fails
    trapped = scenario == "u-trap" or draw.random() < 0.3
    outcome = "success" if not lost else "timeout" if trapped else "collision"
    oracle = 40 + 3 * course.random()
    path = oracle * (1.02 + 0.05 * draw.random())
    latency = UPDATE_MS[model] + 4
    clearance = 0.2 if outcome == "collision" else 0.45 + 0.9 * draw.random()
    return [scenario, seed, model, guidance, speed, outcome, f"{clearance:.4f}", f"{path:.3f}",
            f"{path / speed + 2:.3f}", "primitives", "none", 1, "optimistic", f"{oracle:.3f}",
            f"{3 + 4 * draw.random():.3f}", f"{15 + 10 * draw.random():.3f}", 110,
            int(latency > 80) * 20, draw.randrange(3), f"{latency:.3f}", f"{1.6 * latency:.3f}",
            f"{2.5 * latency:.3f}", "0123456789abcdef", "0.1.0", "dusty", "unbiased"]


def rows():
    for scenario in SCENARIOS:
        for model in UPDATE_MS:
            for seed in range(1000, 1020 if model == "O-Full-0.2" else 1060):
                yield row(scenario, seed, model, "astar", 4)
        for seed in range(1000, 1060):
            yield row(scenario, seed, "W-RoI", "straight", 4)
            if scenario.startswith("forest"):
                for speed in (6, 8, 10):
                    yield row(scenario, seed, "W-RoI", "astar", speed)
                    yield row(scenario, seed, "W-Full", "astar", speed)
        if scenario == "u-trap":
            for seed in range(1000, 1020):
                yield row(scenario, seed, "O-Full-0.4", "straight", 4)


def profile():
    stages = {"filter": 0.8}
    for model, update_ms in UPDATE_MS.items():
        stages[f"{model}/update"] = update_ms
        stages[f"{model}/astar"] = 1.7
        stages[f"{model}/straight"] = 0.01
        stages[f"{model}/astar+primitives"] = 1.6
        stages[f"{model}/straight+primitives"] = 1.8
    quantiles = {name: [round(ms * (0.7 + 0.04 * i + (0.5 if i == 20 else 0)), 4)
                        for i in range(21)] for name, ms in stages.items()}
    return {"machine": "a machine that is not there", "made_by": "sample_runs.py",
            "date": "2000-01-01", "quantiles_ms": quantiles}


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    text = "\n".join([HEADER] + [",".join(map(str, r)) for r in rows()])
    (folder / "runs.csv").write_text(text + "\n")
    (folder / "profile.json").write_text(json.dumps(profile()))
    memory = ["model,path_m,bytes"]
    for model, per_m in (("W-RoI", 0), ("W-Full", 0), ("O-Full-0.4", 9e4), ("G-Full", 0)):
        memory += [f"{model},{d},{2e6 + 1e4 * min(d, 20) + per_m * d:.0f}"
                   for d in range(0, 1001, 20)]
    (folder / "memory.csv").write_text("\n".join(memory) + "\n")


main()
