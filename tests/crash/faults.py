#!/usr/bin/env python3
"""Full disks, read-only folders, signals, closed pipes, and runs that meet at one file.

  SPINCAT_COMMAND=build/release/spincat [SPINCAT_FULL=1] tests/crash/faults.py [TEST ...]

With SPINCAT_FULL every command gets every signal, and runs meet more often.
Exit codes: 2 bad input, 1 what the run could not do, 128 + n ended by signal n.
"""
import ctypes
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from jobs import JOBS, SMALL, lasting, listed_frames, make_data

PROGRAM = os.path.abspath(os.environ["SPINCAT_COMMAND"])
FULL = "SPINCAT_FULL" in os.environ
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
LONG = "--points 8000 --spin-points 800 --copies 60 --threads 2"
# Each lasts for many seconds when nobody ends it.
LASTING = {
    "train": f"train shapes -o x.spincat {LONG}",
    "evaluate": f"evaluate shapes --report e.html {LONG}",
    "sweep": f"sweep shapes --vary c=1,10 -o w.csv {LONG}",
    "describe": "describe ball.off -o s.npy --surface samples --points 400000 --spin-points 400000 --image-width 64 --threads 2",
    "classify": "classify small.spincat many --threads 2",
    "camera": "camera small.spincat frames --loop --quiet --masks masks",
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
        make_data(cls.data, PROGRAM)
        (cls.data / "many").mkdir()
        for k in range(20_000):
            (cls.data / "many" / f"{k}.off").symlink_to("../ball.off")
        cls.inputs = set(os.listdir(cls.data))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def tearDown(self):
        for name in set(os.listdir(self.data)) - self.inputs:
            if (self.data / name).is_dir():
                shutil.rmtree(self.data / name)
            else:
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
                    left = self.left() - {"w.csv.journal", "masks"}
                    masks = self.data / "masks"
                    left |= {mask.name for mask in masks.iterdir() if mask.suffix != ".png"} if masks.exists() else set()
                    self.tearDown()
                    self.assertEqual(left, set())

    def test_a_signal_ends_info(self):
        """Which is done with any file of reasonable size before a signal comes: here it waits for a pipe's first bytes."""
        for number in SIGNALS if FULL else SIGNALS[:1]:
            with self.subTest(signal=number.name):
                os.mkfifo(self.data / "pipe.off")
                process = self.start("info pipe.off --report i.html")
                pipe = None
                while pipe is None and process.poll() is None:
                    try:
                        pipe = os.open(self.data / "pipe.off", os.O_WRONLY | os.O_NONBLOCK)
                    except OSError:  # nobody reads yet
                        time.sleep(0.01)
                process.send_signal(number)
                os.write(pipe, b"OFF\n")
                os.close(pipe)
                out, err = process.communicate(timeout=60)
                self.assertEqual((process.returncode, out, err), (128 + number, "", "spincat: interrupted\n"))
                self.assertEqual(self.left(), {"pipe.off"})
                self.tearDown()

    def test_a_reader_that_has_gone(self):
        small = f"--splits 2 --copies 0 --background 4 {SMALL}"
        for arguments in ("info small.spincat", "info ball.off --json", "--help", "classify small.spincat many",
                          f"evaluate shapes --json {small}", f"sweep shapes --vary c=1,10 {small}",
                          "camera small.spincat frames --quiet"):
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
            self.assertEqual(self.run_command(f"train shapes -o x.spincat --seed {seed} --copies 0 --background 4 {SMALL}")[0], 0)
            models[seed] = (self.data / "x.spincat").read_bytes()
        for _ in range(10 if FULL else 2):
            both = [self.start(f"train shapes -o x.spincat --seed {seed} --copies 0 --background 4 {SMALL}") for seed in (1, 2)]
            for process in both:
                process.communicate()
                self.assertEqual(process.returncode, 0)
            self.assertIn((self.data / "x.spincat").read_bytes(), models.values())
            self.assertEqual(self.left(), {"x.spincat"})

    def test_two_runs_that_write_one_report_or_one_array(self):
        evaluate = [f"evaluate shapes --report e.html --splits {n} --copies 0 --background 4 {SMALL}" for n in (1, 2)]
        spin = [f"spin ball.off -o s.npy --image-width {n} --threads 1" for n in (8, 12)]
        for commands, results in ((evaluate, JOBS["evaluate"].results), (spin, ["s.npy"])):
            whole = {}
            for arguments in commands:
                self.assertEqual(self.run_command(arguments)[0], 0)
                for name in results:
                    whole.setdefault(name, []).append(lasting(name, (self.data / name).read_bytes()))
            for _ in range(10 if FULL else 2):
                both = [self.start(arguments) for arguments in commands]
                for process in both:
                    process.communicate()
                    self.assertEqual(process.returncode, 0)
                for name in results:
                    self.assertIn(lasting(name, (self.data / name).read_bytes()), whole[name], name)
                self.assertEqual(self.left(), set(results))
            self.tearDown()

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


def fill(disk, free):
    """Leaves so many kB of the disk."""
    subprocess.run(["dd", "if=/dev/zero", f"of={disk}/fill", "bs=1k"], stderr=subprocess.DEVNULL, check=False)
    os.truncate(f"{disk}/fill", max(0, os.path.getsize(f"{disk}/fill") - free * 1024))


def resize(disk, size):
    ms_remount = 32
    assert ctypes.CDLL(None).mount(b"tmpfs", os.fsencode(disk), b"tmpfs", ms_remount, b"size=" + size) == 0


class SmallDisk:
    """Commands whose results go to a disk that is full."""

    def __init__(self, disk):
        self.disk = Path(disk)
        self.failures = 0

    def run(self, arguments):
        return subprocess.run([PROGRAM, *arguments.split()], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=False)

    def fail(self, what, done, why):
        print(f"{what}: {why}: exit code {done.returncode}, {done.stderr}")
        self.failures += 1

    def expect_full(self, what, done):
        if done.returncode != 1 or done.stderr.count("\n") != 1 or "no space left" not in done.stderr:
            self.fail(what, done, "no word of a full disk")

    def clear(self):
        for name in os.listdir(self.disk):
            file = self.disk / name
            shutil.rmtree(file) if file.is_dir() else file.unlink()

    def check_results(self, what, arguments, results, empty=()):
        """The former results stay and nothing else, but for files in `empty`, where nothing was written."""
        for result in results:
            (self.disk / result).write_bytes(b"old")
        fill(self.disk, 0)
        done = self.run(arguments)
        self.expect_full(what, done)
        if any((self.disk / result).read_bytes() != b"old" for result in results):
            self.fail(what, done, "a former result was harmed")
        left = set(os.listdir(self.disk)) - set(results) - {"fill"}
        left -= {name for name in empty if name in left and not (self.disk / name).stat().st_size}
        if left:
            self.fail(what, done, f"left {left}")
        self.clear()

    def check_journal(self, what, arguments, room, goes_on=False):
        """The disk has so many kB, less than the journal takes: with more the same command goes on from what there is."""
        if room:
            resize(self.disk, b"%dk" % room)
        else:
            fill(self.disk, 0)
        done = self.run(arguments)
        self.expect_full(what, done)
        resize(self.disk, b"4m")
        again = self.run(arguments)
        if again.returncode != 0 or (goes_on and "were of use" not in again.stderr):
            self.fail(what, again, "with more room")
        self.clear()
        resize(self.disk, b"64k")

    def check_frames(self, what, option, free):
        """A folder of frames holds whole pictures alone, and is a recording that can be read."""
        fill(self.disk, free)
        done = self.run(f"camera small.spincat frames --quiet {option} {self.disk}/seen")
        self.expect_full(what, done)
        seen = self.disk / "seen"
        if any(name not in ("camera.txt", "depth.txt") and not name.endswith(".png") for name in os.listdir(seen)):
            self.fail(what, done, f"left {os.listdir(seen)}")
        if free and option == "--record":
            read = self.run(f"camera small.spincat {seen} --quiet")
            frames = [line for line in map(json.loads, read.stdout.splitlines()) if "frame" in line]
            list_is_whole = (seen / "depth.txt").read_bytes().endswith(b"\n")
            if read.returncode != 0 or not frames or len(frames) != len(listed_frames(seen)) or not list_is_whole:
                self.fail(what, read, f"{len(frames)} of {len(listed_frames(seen))} frames of what was recorded")
        self.clear()


def on_small_disk(disk, data):
    """In a process of its own: every result goes to a disk that is full."""
    os.chdir(data)
    if not mount_small_disk(disk):
        return 77
    small = SmallDisk(disk)
    for name in ("train", "spin", "sheet", "evaluate"):
        job = JOBS[name]
        words = job.arguments.replace(job.journal or " ", " none" if job.journal else " ").split()
        small.check_results(name, " ".join(f"{disk}/{word}" if word in job.results else word for word in words),
                            job.results)
    small.check_results("classify", f"classify small.spincat ball.off --report {disk}/c.html", ["c.html"])
    small.check_results("info", f"info ball.off --report {disk}/i.html", ["i.html"])
    sweep = f"sweep shapes --vary c=1,10 --splits 2 --copies 0 --background 4 {SMALL} -o {disk}/w.json"
    small.check_results("sweep", sweep, ["w.json"], empty=["w.json.journal"])
    evaluate = f"evaluate shapes --splits 2 --copies 1 --background 4 {SMALL} --journal {disk}/e.journal"
    for room in (0, 64, 128, 256, 512, 1024) if FULL else (0, 512):
        small.check_journal(f"a journal with {room} kB", evaluate, room, goes_on=room >= 512)
    small.check_journal("a sweep's journal", sweep, 0)
    for option in ("--record", "--masks"):
        for free in (0, 24):
            small.check_frames(f"{option} with {free} kB", option, free)
    return 1 if small.failures else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--on-small-disk"]:
        sys.exit(on_small_disk(*sys.argv[2:4]))
    unittest.main(verbosity=2)
