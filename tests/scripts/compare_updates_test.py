"""scripts/compare-updates: published examples of its statistics, and made-up tables."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts/compare-updates"
HEADER = ("scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,pose_error,latency_scale,unknown,"
          "air,distance")


def load():
    loader = importlib.machinery.SourceFileLoader("compare_updates", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def near(found, expected, within=1e-4):
    assert all(abs(a - b) < within for a, b in zip(found, expected, strict=True)), (found, expected)


def row(seed, outcome, time_s="8", model="W-RoI"):
    return f"forest-0.10,{seed},{model},astar,10,{outcome},0.7,40,{time_s},primitives,none,1,optimistic,dusty,unbiased"


def compare(*tables):
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, table in enumerate(tables):
            files.append(pathlib.Path(folder, f"{number}.csv"))
            files[-1].write_text("\n".join(table) + "\n", encoding="utf-8")
        return subprocess.run([SCRIPT, *files], capture_output=True, text=True, check=False)


def test_statistics():
    compared = load()
    near(compared.wilson(81, 263), (0.2553, 0.3662))  # Newcombe 1998, single proportion, method 3
    near(compared.wilson(0, 20), (0, 0.1611))
    near(compared.newcombe(36, 12, 2, 0), (0.0569, 0.3404))  # Newcombe 1998, paired data, method 10
    near(compared.newcombe(59, 6, 16, 80), (-0.1186, -0.0046))  # Fagerland et al. 2017, chapter 8
    near([compared.mcnemar(6, 16)], [0.0525])  # likewise
    assert compared.mcnemar(0, 0) == 1


def test_pairs_are_of_the_same_course_and_model():
    whole = [HEADER, row(1, "success"), row(2, "collision"), row(3, "success", "9"), row(4, "success"),
             row(1, "collision", model="W-Full")]
    sectors = [HEADER + ",updates", row(1, "success", "7") + ",sectors", row(2, "success") + ",sectors",
               row(3, "timeout") + ",sectors", row(5, "collision") + ",sectors", row(1, "success") + ",scans"]
    done = compare(whole, sectors)
    lines = done.stdout.splitlines()
    assert done.returncode == 0 and len(lines) == 3, done
    fields = [field.strip() for field in lines[2].strip("|").split("|")]
    assert fields[:4] == ["`forest-0.10`", "10", "`W-RoI`", "3"], fields
    assert fields[4].startswith("2 (66.7 %") and fields[5].startswith("2 (66.7 %"), fields
    assert fields[6].startswith("+0.0 (") and fields[7:10] == ["1 / 1", "1", "1 / 0"], fields
    assert fields[10] == "8.00 / 7.00", fields


def test_what_cannot_be_compared_is_told():
    whole = [HEADER, row(1, "success")]
    for tables, said in (((whole,), "no course was flown"), ((["a,b", "1,2"],), "is no table"),
                         ((whole, [HEADER + ",updates,settings", row(1, "success") + ",sectors,f00d"]), "with other settings than"),
                         ((whole, [HEADER, row(1, "timeout")]), "contradicts another table: seed 1 of forest-0.10")):
        done = compare(*tables)
        assert done.returncode == 1 and said in done.stderr and not done.stdout, done
    done = subprocess.run([SCRIPT, "/none.csv"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "/none.csv" in done.stderr, done


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
