"""Shared by the tests: the project's recordings and programs."""
import os
import pathlib
import subprocess

import pytest

SOURCES = pathlib.Path(__file__).resolve().parents[2]
POLES = SOURCES / "rawlogs" / "poles_and_wall.rawlog"
ORCHARD = SOURCES / "rawlogs" / "orchard.rawlog"


@pytest.fixture(scope="session")
def program():
    """Runs a program of the build, and returns its output."""
    folder = os.environ.get("HAGEN_BIN")
    if not folder:
        pytest.skip("HAGEN_BIN is not set to the folder of the programs")

    def run(name, *arguments):
        command = [pathlib.Path(folder) / name, *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run


@pytest.fixture(scope="session")
def poles_labels(program, tmp_path_factory):
    """The scan folder that rawlog-segment writes for poles_and_wall.rawlog."""
    folder = tmp_path_factory.mktemp("poles") / "labels"
    program("rawlog-segment", "-i", POLES, "--kitti", folder, "-c", "vlp16", "-q")
    return folder
