"""pip's way to the Python package: CMake builds the compiled part, as for everybody else.

SPINCAT_BUILD names a build folder that is there already; without it one is made in build/pip.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


def version():
    return re.search(r"project\(spincat VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


def run(*command):
    try:
        subprocess.run(list(map(str, command)), check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise SystemExit(f"spincat needs CMake 3.24, Ninja, g++ 12 and the libraries of scripts/packages.sh: {error}")


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        build = pathlib.Path(os.environ.get("SPINCAT_BUILD", SOURCE / "build" / "pip"))
        if "SPINCAT_BUILD" not in os.environ:
            run("cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", "-DCMAKE_UNITY_BUILD=ON", "-DSPINCAT_TESTS=OFF",
                "-DSPINCAT_MPI=OFF", "-DSPINCAT_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}")  # fmt: skip
            run("cmake", "--build", build, "--target", "spincat_python")
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(next((build / "python" / "spincat").glob("_spincat.*.so")), target)


setup(version=version(), ext_modules=[Extension("spincat._spincat", sources=[])], cmdclass={"build_ext": BuildByCMake})
