"""Builds a wheel of the package without MRPT: the filter, presets, scores, and network captures.
Needs the build packages of Debian (scripts/install-packages --build). See scripts/wheel."""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build/wheel"
BUILD.mkdir(parents=True, exist_ok=True)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DHAGEN_WHEEL=ON", f"-DPython_EXECUTABLE={sys.executable}"]
        for step in (["-G", "Ninja", "-S", ROOT, "-B", build, *options, *os.environ.get("CMAKE_ARGS", "").split()],
                     ["--build", build, "--target", "_hagen"],
                     ["--install", build, "--prefix", pathlib.Path(self.build_lib).resolve(), "--strip"]):
            subprocess.run(["cmake", *map(str, step)], check=True)


setup(
    version=re.search(r"VERSION (\d+\.\d+\.\d+)\n", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1],
    ext_modules=[Extension("hagen._hagen", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": str(BUILD)}, "egg_info": {"egg_base": str(BUILD)}},
)
