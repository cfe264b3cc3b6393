"""Names, type stubs and presets of the package, and the examples."""
import ast
import os
import pathlib
import pickle
import subprocess
import sys

import pytest
from conftest import SOURCES

import hagen

PACKAGE = pathlib.Path(hagen.__file__).parent


def members(of):
    return {name for name in vars(of) if not name.startswith("_")}


def test_stubs_have_every_name():
    stubs = ast.parse((PACKAGE / "__init__.pyi").read_text())
    classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
    names = set(classes)
    names |= {node.name for node in stubs.body if isinstance(node, ast.FunctionDef)}
    names |= {node.target.id for node in stubs.body if isinstance(node, ast.AnnAssign)}
    assert names == set(hagen.__all__)
    for name, stub in classes.items():
        if name == "SettingsError":
            continue
        public = {node.name for node in stub.body if not node.name.startswith("_")}
        assert public == members(getattr(hagen, name)), name
    assert (PACKAGE / "py.typed").exists()


def test_everything_is_documented():
    for name in hagen.__all__:
        what = getattr(hagen, name)
        if isinstance(what, (int, str)) or name == "SettingsError":
            continue
        assert what.__doc__, name
        if isinstance(what, type):
            for member in members(what):
                assert vars(what)[member].__doc__, f"{name}.{member}"


ARGUMENTS = {"segment": ([],), "__add__": (hagen.Scores(),), "__iadd__": (hagen.Scores(),)}


@pytest.mark.parametrize(
    "name", ["ClassScore", "Filter", "Recording", "Result", "Scan", "Scores", "Simulation"]
)
def test_rejects_uninitialized_objects(name):
    """Using objects created by __new__() alone would read uninitialized memory."""
    of = getattr(hagen, name)
    own = members(of) | {"__len__", "__length_hint__", "__next__", "__repr__", "__add__", "__iadd__"}
    for member in own & set(vars(of)):
        empty = of.__new__(of)
        with pytest.raises(TypeError, match=f"{name}: the object is empty"):
            getattr(empty, member)(*ARGUMENTS.get(member, ()))


def test_rejects_uninitialized_scan():
    with pytest.raises(TypeError, match="Scan: the object is empty"):
        hagen.Filter().segment(hagen.Scan.__new__(hagen.Scan))


def test_object_is_empty_before_init():
    class Early(hagen.Filter):
        def __init__(self):
            with pytest.raises(TypeError, match="Early: the object is empty"):
                self.settings
            super().__init__("vlp16", zone_m=9)

    assert "zone_m: 9 " in Early().settings


def test_lists_project_presets():
    assert {"vlp16", "hdl32e", "hdl64e", "mid360", "paper"} <= set(hagen.presets())
    for preset in ("vlp16", "hdl32e", "hdl64e", "mid360", "paper", "ouster_os1_64"):
        hagen.Filter(preset)


def test_prefers_own_presets(tmp_path):
    (tmp_path / "mine.yaml").write_text("include: vlp16\nzone_m: 7\n")
    code = "import hagen; print(hagen.Filter('mine').settings)"
    environment = {**os.environ, "HAGEN_CONFIG_PATH": str(tmp_path)}
    printed = subprocess.run(
        [sys.executable, "-c", code], env=environment, check=True, capture_output=True, text=True
    ).stdout
    assert "zone_m: 7 " in printed and "VLP-16" in printed


def test_preset_names_may_be_non_utf8(tmp_path):
    (tmp_path / os.fsdecode(b"m\xffne.yaml")).write_text("zone_m: 7\n")
    code = """
import os, hagen
name = os.fsdecode(b'm\\xffne')
assert name in hagen.presets()
print(hagen.Filter(name).settings)
"""
    environment = {**os.environ, "HAGEN_CONFIG_PATH": str(tmp_path)}
    printed = subprocess.run(
        [sys.executable, "-c", code], env=environment, check=True, capture_output=True, text=True
    ).stdout
    assert "zone_m: 7 " in printed


def test_mrpt_out_of_memory_raises():
    """The linker lists the allocator of MRPT's clouds: ours throws, MRPT's returns nullptr."""
    environment = {**os.environ, "LD_DEBUG": "bindings", "LD_BIND_NOW": "1"}
    output = subprocess.run(
        [sys.executable, "-c", "import hagen"], env=environment, check=True, capture_output=True
    ).stderr.decode(errors="replace")
    used = [
        line
        for line in output.splitlines()
        if "binding file" in line and "libmrpt-maps" in line.split(" to ")[0]
        and "aligned_mallocEmm" in line
    ]
    assert all("_hagen" in line.split(" to ")[1] for line in used), used
    assert used


@pytest.mark.parametrize("example", ["plot_obstacles.py", "walk_through.py"])
def test_examples_draw_pictures(example, tmp_path):
    pytest.importorskip("matplotlib")
    recording = SOURCES / "rawlogs" / "orchard.rawlog"
    folder = tmp_path / "made" / "by the example"
    subprocess.run(
        [sys.executable, SOURCES / "examples" / "python" / example, recording, folder],
        env={**os.environ, "MPLBACKEND": "Agg"},
        check=True,
    )
    pictures = list(folder.glob("*.png"))
    assert pictures and all(picture.stat().st_size > 10000 for picture in pictures)


@pytest.mark.parametrize("example", ["plot_obstacles.py", "walk_through.py"])
def test_examples_need_display_or_folder(example):
    pytest.importorskip("matplotlib")
    recording = SOURCES / "rawlogs" / "poles_and_wall.rawlog"
    run = subprocess.run(
        [sys.executable, SOURCES / "examples" / "python" / example, recording],
        env={**os.environ, "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1
    assert "FOLDER" in run.stderr and "Traceback" not in run.stderr


@pytest.mark.parametrize("example", ["plot_obstacles.py", "walk_through.py"])
def test_examples_report_unreadable_files(example, tmp_path):
    pytest.importorskip("matplotlib")
    run = subprocess.run(
        [sys.executable, SOURCES / "examples" / "python" / example, "no_such.pcap", tmp_path],
        env={**os.environ, "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1
    assert "no_such.pcap" in run.stderr and "Traceback" not in run.stderr


def test_pickling_raises():
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        with pytest.raises(TypeError):
            pickle.dumps(hagen.Filter(), protocol)
    with pytest.raises(TypeError):
        hagen.Filter.__base__()
