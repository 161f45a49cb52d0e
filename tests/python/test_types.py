"""The annotations, by mypy: of the package itself, and of the examples as its users."""

import os
import subprocess
import sys
import unittest

from support import SOURCE, Folder

import spincat


class Types(Folder):
    def test_mypy_finds_nothing(self):
        if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True, check=False).returncode:
            raise unittest.SkipTest("mypy is not installed")
        cache = os.environ.get("SPINCAT_MYPY_CACHE", self.folder)
        examples = sorted((SOURCE / "examples/python").glob("*.py"))
        for files in ([SOURCE / "python/spincat"], examples):
            done = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--no-warn-unused-ignores", "--cache-dir", cache, *files],
                capture_output=True,
                text=True,
                check=False,
                env={**os.environ, "MYPYPATH": str(SOURCE / "python")},
            )
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_has_what_the_module_has(self):
        stub = (SOURCE / "python/spincat/_spincat.pyi").read_text()
        for name in dir(spincat._spincat):
            if not name.startswith("__"):
                self.assertRegex(stub, rf"(class|def) {name}\b")
        for kind in (spincat.Object, spincat.Ballot, spincat.Evaluation, spincat.Rate, spincat._spincat.Model):
            for name in vars(kind):
                if not name.startswith("__"):
                    self.assertRegex(stub, rf"def {name}\b")
