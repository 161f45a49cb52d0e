"""pip install . and CMake's component, from what is built already."""

import importlib.util
import os
import shutil
import subprocess
import sys
import unittest

from support import SMALL, SOURCE, Folder, boxes

import spincat

BUILD = os.environ.get("SPINCAT_BUILD", "")


@unittest.skipUnless(BUILD, "SPINCAT_BUILD is not set")
class Install(Folder):
    def run_quietly(self, *command, **environment):
        clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, cwd=self.folder, env={**clean, **environment})  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def names_a_board(self, python, **environment):
        model = self.folder / "boxes.spincat"
        objects, labels = boxes(2)
        spincat.Classifier(**SMALL).fit(objects, labels).save(model)
        spincat.write(objects[0], self.folder / "board.ply")
        code = "import spincat; print(spincat.__file__); print(spincat.Classifier.load('boxes.spincat').predict(['board.ply'])[0])"
        place, name = self.run_quietly(python, "-c", code, **environment).splitlines()
        self.assertEqual(name, "board")
        return place

    # Debian's setuptools alone: nothing is asked of the network.
    def test_pip_in_a_virtual_environment(self):
        for needed in ("pip", "setuptools", "wheel", "ensurepip"):
            if importlib.util.find_spec(needed) is None:
                self.skipTest(f"{needed} is not installed")
        source = self.folder / "source"  # setuptools leaves its files beside the sources
        source.mkdir()
        for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "README.md"):
            shutil.copy2(SOURCE / name, source)
        shutil.copytree(SOURCE / "python", source / "python")
        self.run_quietly(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", "env")
        python = self.folder / "env/bin/python3"
        self.run_quietly(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--quiet", source)
        self.assertIn(str(self.folder / "env"), self.names_a_board(python))

    def test_component_of_cmake(self):
        prefix = self.folder / "prefix"
        self.run_quietly("cmake", "--install", BUILD, "--prefix", prefix, "--component", "python")
        packages = prefix / "lib/python3/dist-packages"
        self.assertTrue((packages / "spincat/py.typed").is_file())
        self.assertIn(str(prefix), self.names_a_board(sys.executable, PYTHONPATH=str(packages)))
