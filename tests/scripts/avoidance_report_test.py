"""scripts/avoidance-report: synthetic campaigns with known results."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts/avoidance-report"
HEADER = ("scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,pose_error,latency_scale,"
          "unknown,emergency_stops,latency_p50_ms,latency_p95_ms,settings,version,air,distance")


def flights(scenario, model, count, failed=(), planner="primitives", latency_ms=5):
    return [f"{scenario},{seed},{model},astar,4,{'collision' if seed in failed else 'success'},0.7,40,11,"
            f"{planner},none,1,optimistic,1,"
            f"{latency_ms},{2 * latency_ms},f00d,0.1,dusty,unbiased" for seed in range(count)]


def report(rows, memory=None):
    """The page, summary.csv and pairs.csv of a campaign."""
    with tempfile.TemporaryDirectory() as place:
        folder, out = pathlib.Path(place, "campaign"), pathlib.Path(place, "out")
        folder.mkdir()
        (folder / "runs.csv").write_text("\n".join([HEADER, *rows]) + "\n", encoding="utf-8")
        (folder / "campaign.json").write_text(json.dumps({"profile": {"machine": "a computer"}}), encoding="utf-8")
        if memory:
            (folder / "memory.csv").write_text(memory, encoding="utf-8")
        subprocess.run([SCRIPT, folder, "-o", out], check=True, stdout=subprocess.DEVNULL)
        assert {file.name for file in (out / "avoidance").iterdir()} == {
            "summary.csv", "pairs.csv", "static.png", "moving.png"}

        def read(name):
            with open(out / "avoidance" / name, encoding="utf-8", newline="") as table:
                return list(csv.DictReader(table))
        return (out / "avoidance.md").read_text(encoding="utf-8"), read("summary.csv"), read("pairs.csv")


def test_success_has_wilson_interval():
    _, summary, _ = report(flights("wires", "W-RoI", 263, failed=range(81, 263)))
    row = summary[0]
    assert (row["flights"], row["success"], row["collision"], row["timeout"]) == ("263", "81", "182", "0"), row
    assert (row["success_low"], row["success_high"]) == ("0.2553", "0.3662"), row  # Newcombe 1998, method 3


def test_pairs_are_tested_on_shared_courses():
    page, _, pairs = report(flights("gap", "W-RoI", 80) + flights("gap", "G-Full", 60, failed=range(10)) +
                            flights("gap", "W-Full", 60, failed=range(8)))
    by_model = {pair["second"]: pair for pair in pairs}
    grid = by_model["G-Full"]
    assert [grid[key] for key in ("courses", "only_first", "only_second")] == ["60", "10", "0"], grid
    assert float(grid["p"]) == 0.001953, grid  # 2 / 2^10
    assert float(grid["p_holm"]) == 0.003906 and float(by_model["W-Full"]["p_holm"]) == 0.007812, pairs  # 2 / 2^8
    assert "RoI window reached the goal more often than the occupancy grid 0.2 m (60 vs. 50 of 60 flights)" in page
    assert "and the full window (60 vs. 52 of 60 flights) in `gap` at 4 m/s." in page


def test_few_courses_are_not_tested():
    page, _, pairs = report(flights("movers", "W-RoI", 49) + flights("movers", "G-Full", 200, failed=range(49)))
    assert (pairs[0]["result"], pairs[0]["p"]) == ("too few flights", ""), pairs
    assert "- **Moving obstacles**: too few flights.\n" in page
    assert "- **Static obstacles**: too few flights.\n" in page


def test_equal_models_have_no_difference():
    page, _, pairs = report(flights("gap", "W-RoI", 50, failed=[1]) + flights("gap", "G-Full", 50, failed=[1]))
    assert (pairs[0]["result"], pairs[0]["p"]) == ("no difference found", "1"), pairs
    assert "No difference was found between the RoI window and the occupancy grid 0.2 m in `gap` at 4 m/s." in page


def test_other_conditions_are_reported_separately():
    page, _, pairs = report(flights("gap", "W-RoI", 50) + flights("gap", "G-Full", 50) +
                            flights("gap", "W-RoI", 6, planner="3dvfh") + flights("gap", "G-Full", 6, planner="3dvfh"))
    assert sorted(pair["courses"] for pair in pairs) == ["50", "6"], pairs
    assert "planner 3dvfh (6)" in page


def test_cost_uses_shared_courses_only():
    page, _, _ = report(flights("gap", "W-RoI", 5) + flights("gap", "G-Full", 4, latency_ms=20) +
                        flights("street", "G-Full", 9, latency_ms=90),
                        "model,path_m,bytes\nW-RoI,0,1\nW-RoI,1000,1500000\nG-Full,1000,90000000\n")
    assert "|RoI window|5.0|10.0|25.0|1.50|\n|occupancy grid 0.2 m|20.0|40.0|25.0|90.00|\n" in page
    assert "it uses 1.5 MB, the maps 90 to 90 MB" in page


def test_missing_campaign_is_reported():
    done = subprocess.run([SCRIPT, "/none"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "/none/runs.csv: No such file" in done.stderr, done


if __name__ == "__main__":
    if subprocess.run(["/usr/bin/python3", "-c", "import jinja2, matplotlib, pandas, scipy"], check=False,
                      stderr=subprocess.DEVNULL).returncode:
        sys.exit(77)  # skipped
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
