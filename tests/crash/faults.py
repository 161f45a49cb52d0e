#!/usr/bin/env python3
"""Full disks, read-only folders, signals, closed pipes, and runs that meet at one file.

  SPINCAT_COMMAND=build/release/spincat [SPINCAT_FULL=1] tests/crash/faults.py [TEST ...]

With SPINCAT_FULL every command gets every signal, and runs meet more often.
Exit codes: 2 bad input, 1 what the run could not do, 128 + n ended by signal n.
"""
import ctypes
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from jobs import JOBS, SMALL, make_data

PROGRAM = os.path.abspath(os.environ["SPINCAT_COMMAND"])
FULL = "SPINCAT_FULL" in os.environ
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
LONG = "--points 8000 --spin-points 800 --copies 60 --threads 2"
# Each lasts for many seconds when nobody ends it.
LASTING = {
    "train": f"train shapes -o x.spincat {LONG}",
    "evaluate": f"evaluate shapes --report e.html {LONG}",
    "sweep": f"sweep shapes --vary c=1,10 -o w.csv {LONG}",
    "spin": "spin ball.off -o s.npy --surface samples --points 400000 --image-width 64 --encode mean-image --threads 2",
    "classify": "classify small.spincat many --threads 2",
}


def mount_small_disk(folder):
    """A disk of 64 kB for this process and its children alone; says whether that is allowed here."""
    libc = ctypes.CDLL(None, use_errno=True)
    clone_newns, ms_private_rec = 0x20000, (1 << 18) | (1 << 14)
    return (libc.unshare(clone_newns) == 0 and libc.mount(b"none", b"/", None, ms_private_rec, None) == 0 and
            libc.mount(b"tmpfs", os.fsencode(folder), b"tmpfs", 0, b"size=64k") == 0)


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.data = Path(cls.scratch.name)
        make_data(cls.data)
        subprocess.run([PROGRAM, *f"train shapes -o small.spincat --copies 0 {SMALL}".split()], cwd=cls.data, check=True,
                       stdout=subprocess.DEVNULL)
        (cls.data / "many").mkdir()
        for k in range(20_000):
            (cls.data / "many" / f"{k}.off").symlink_to("../ball.off")
        cls.inputs = set(os.listdir(cls.data))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def tearDown(self):
        for name in set(os.listdir(self.data)) - self.inputs:
            (self.data / name).unlink()

    def start(self, arguments, **more):
        options = {"cwd": self.data, "stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
                   "text": True, **more}
        return subprocess.Popen([PROGRAM, *arguments.split()], **options)

    def run_command(self, arguments, **more):
        process = self.start(arguments, **more)
        out, err = process.communicate()
        return process.returncode, out, err

    def expect_refusal(self, result, words, code=1):
        self.assertEqual(result[0], code, result)
        self.assertIn(words, result[2])
        self.assertEqual(result[2].count("\n"), 1, result[2])
        self.assertTrue(result[2].startswith("spincat: "), result[2])

    def left(self):
        return set(os.listdir(self.data)) - self.inputs

    def test_signals_end_every_command_cleanly(self):
        for i, (name, arguments) in enumerate(LASTING.items()):
            for number in SIGNALS if FULL else [SIGNALS[i % 2]]:
                with self.subTest(command=name, signal=number.name):
                    process = self.start(arguments, stdout=subprocess.DEVNULL)
                    time.sleep(0.5)
                    process.send_signal(number)
                    err = process.communicate(timeout=60)[1]
                    self.assertEqual(process.returncode, 128 + number)
                    self.assertEqual(err, "spincat: interrupted\n")
                    left = self.left() - {"w.csv.journal"}
                    self.tearDown()
                    self.assertEqual(left, set())

    def test_a_reader_that_has_gone(self):
        for arguments in ("info small.spincat", "info ball.off --json", "--help", "classify small.spincat many"):
            for ignored in (False, True):
                with self.subTest(arguments=arguments, sigpipe_ignored=ignored):
                    read_end, write_end = os.pipe()
                    os.close(read_end)
                    code, _, err = self.run_command(arguments, stdout=write_end, restore_signals=not ignored)
                    os.close(write_end)
                    if ignored:  # by the caller: then it is an error as any other
                        self.assertEqual(code, 1, err)
                        self.assertEqual(err.splitlines()[-1], "spincat: standard output: Broken pipe")
                    else:
                        self.assertEqual(code, -signal.SIGPIPE)
                        self.assertEqual(err, "")

    def test_a_folder_that_cannot_be_written_to(self):
        for name in ("train", "sheet", "spin", "sweep", "evaluate"):
            arguments = JOBS[name].arguments.replace(" -o ", " -o /proc/self/").replace("--report ", "--report /proc/self/")
            with self.subTest(command=name):
                code, _, err = self.run_command(arguments)
                self.assertIn(code, (1, 2))
                self.assertEqual(err.count("\n"), 1, err)
                self.assertRegex(err, r"spincat: /proc/self/\S+: cannot write: ")

    def test_a_full_disk_costs_no_former_result(self):
        with tempfile.TemporaryDirectory() as disk:
            script = Path(__file__).resolve()
            done = subprocess.run([sys.executable, "-B", script, "--on-small-disk", disk, str(self.data)], text=True,
                                  capture_output=True)
            if done.returncode == 77:
                self.skipTest("this user may not mount a small disk")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_two_runs_that_write_one_file(self):
        models = {}
        for seed in (1, 2):
            self.assertEqual(self.run_command(f"train shapes -o x.spincat --seed {seed} --copies 0 {SMALL}")[0], 0)
            models[seed] = (self.data / "x.spincat").read_bytes()
        for _ in range(10 if FULL else 2):
            both = [self.start(f"train shapes -o x.spincat --seed {seed} --copies 0 {SMALL}") for seed in (1, 2)]
            for process in both:
                process.communicate()
                self.assertEqual(process.returncode, 0)
            self.assertIn((self.data / "x.spincat").read_bytes(), models.values())
            self.assertEqual(self.left(), {"x.spincat"})

    def test_two_runs_do_not_share_a_journal(self):
        for name, journal in (("train", "t.journal"), ("sweep", "w.json.journal"), ("evaluate", "t.journal")):
            arguments = {"train": f"train shapes -o x.spincat --journal t.journal {LONG}",
                         "evaluate": f"evaluate shapes --journal t.journal {LONG}",
                         "sweep": f"sweep shapes --vary c=1,10 -o w.json {LONG}"}[name]
            with self.subTest(command=name):
                first = self.start(arguments, stdout=subprocess.DEVNULL)
                while not (self.data / journal).exists():
                    time.sleep(0.01)
                time.sleep(0.3)
                self.expect_refusal(self.run_command(arguments), f"{journal}: is in use by another run")
                first.kill()
                first.communicate()
                self.tearDown()


def on_small_disk(disk, data):
    """In a process of its own: every result goes to a disk that is full."""
    os.chdir(data)
    if not mount_small_disk(disk):
        return 77
    failures = 0
    for name in ("train", "spin", "sheet", "evaluate"):
        job = JOBS[name]
        words = job.arguments.replace(job.journal or " ", " none" if job.journal else " ").split()
        words = [f"{disk}/{word}" if word in job.results else word for word in words]
        for result in job.results:
            Path(disk, result).write_bytes(b"old")
        subprocess.run(["dd", "if=/dev/zero", f"of={disk}/fill", "bs=1k"], stderr=subprocess.DEVNULL)
        done = subprocess.run([PROGRAM, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True)
        unharmed = all(Path(disk, result).read_bytes() == b"old" for result in job.results)
        left = set(os.listdir(disk)) - set(job.results) - {"fill"}
        if done.returncode != 1 or done.stderr.count("\n") != 1 or "no space left" not in done.stderr or not unharmed or left:
            print(name, done.returncode, done.stderr, "unharmed" if unharmed else "HARMED", left)
            failures += 1
        for file in os.listdir(disk):
            Path(disk, file).unlink()
    return 1 if failures else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--on-small-disk"]:
        sys.exit(on_small_disk(*sys.argv[2:4]))
    unittest.main(verbosity=2)
