#!/usr/bin/env python3
"""Kills the commands that write results at random moments and looks at what is left.

  kill_at_random.py SPINCAT FOLDER [ROUNDS [SEED]]

In turn train, evaluate (JSON, report, journal), spin (.npy and .png), sweep (journal) and camera (--record), ROUNDS
times in all; of ten kills eight are SIGKILL, one is SIGTERM and one SIGINT. After each: every result is what it was
before or whole; every frame that a recording lists can be read; after a signal that can be caught, no other file is
left and the exit code is 128 + signal; the same command again (into another folder, where it records) succeeds, goes on
from its journal, gives the results of a run that nobody disturbed, and leaves nothing beside them.
"""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from jobs import FRAMES, JOBS, lasting, listed_frames, make_data

OLD = b"a former result\n"
# In an order in which the first ten rounds have all three.
SIGNALS = [signal.SIGKILL] * 2 + [signal.SIGTERM] + [signal.SIGKILL] * 2 + [signal.SIGINT] + [signal.SIGKILL] * 4


def start(program, folder, job):
    with open(folder / ".out", "wb") as out, open(folder / ".err", "wb") as err:
        return subprocess.Popen([program, *job.arguments.split()], cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                stderr=err)


def files_of(folder):
    return {f.name: f.read_bytes() for f in folder.iterdir() if f.is_file() and f.name not in (".out", ".err")}


class Rounds:
    def __init__(self, program, folder, seed):
        self.program, self.folder = program, folder
        self.random = random.Random(seed)
        self.counts = {"killed": 0, "too late": 0, "old": 0, "new": 0, "leftovers": 0, "resumed": 0, "frames": 0}
        self.signals = set()
        self.failures = []
        make_data(folder, program)
        self.inputs = set(files_of(folder))
        self.whole, self.seconds = {}, {}
        for name, job in JOBS.items():
            begin = time.monotonic()
            if start(program, folder, job).wait() != 0:
                sys.exit(f"{name} fails by itself: {(folder / '.err').read_text()}")
            self.seconds[name] = time.monotonic() - begin
            self.whole[name] = {n: b for n, b in files_of(folder).items() if n not in self.inputs}
            if set(self.whole[name]) != set(job.results):
                sys.exit(f"{name} wrote {sorted(self.whole[name])}")
            if job.recording and len(listed_frames(folder / job.recording)) != FRAMES:
                sys.exit(f"{name} did not record {FRAMES} frames")
            self.clear(job)

    def clear(self, job):
        for name in set(files_of(self.folder)) - self.inputs:
            (self.folder / name).unlink()
        if job.recording:
            shutil.rmtree(self.folder / job.recording, ignore_errors=True)

    def fail(self, text):
        self.failures.append(text)
        print("FAILED:", text, flush=True)

    def is_whole(self, job_name, name, data):
        return lasting(name, data) == lasting(name, self.whole[job_name][name])

    def hit(self, job_name, job, number):
        process = start(self.program, self.folder, job)
        time.sleep(self.random.uniform(0, 1.1 * self.seconds[job_name]))
        process.send_signal(number)
        code = process.wait()
        if code == 0:
            self.counts["too late"] += 1
        else:
            self.counts["killed"] += 1
            caught = number != signal.SIGKILL
            # Before it listens a signal simply ends it.
            if code not in ((-number, 128 + number) if caught else (-number,)):
                self.fail(f"{job_name}: exit code {code} after signal {number}")
        return code

    def check_after_kill(self, job_name, job, number, had_old):
        there = files_of(self.folder)
        left = set(there) - self.inputs - set(job.results) - {job.journal}
        self.counts["leftovers"] += len(left)
        if number != signal.SIGKILL and left:
            self.fail(f"{job_name}: signal {number} left {sorted(left)}")
        for name in job.results:
            if name == job.journal:
                continue
            data = there.get(name)
            if data == (OLD if had_old else None):
                self.counts["old"] += 1
            elif data is not None and self.is_whole(job_name, name, data):
                self.counts["new"] += 1
            else:
                self.fail(f"{job_name}: {name} is neither the former result nor whole")

    def check_recording(self, job_name, job, number):
        recording = self.folder / job.recording
        listed = listed_frames(recording)
        names = os.listdir(recording) if recording.exists() else []
        left = [name for name in names if not name.endswith((".png", ".txt"))]
        self.counts["leftovers"] += len(left)
        self.counts["frames"] += len(listed)
        if number != signal.SIGKILL and left:
            self.fail(f"{job_name}: signal {number} left {sorted(left)}")
        if not listed:
            shutil.rmtree(recording, ignore_errors=True)
            return
        read = subprocess.run([self.program, *f"camera small.spincat {job.recording} --quiet".split()], cwd=self.folder,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        frames = [answer for answer in map(json.loads, read.stdout.splitlines()) if "frame" in answer]
        if read.returncode != 0 or len(frames) != len(listed) or any("error" in frame for frame in frames):
            self.fail(f"{job_name}: {len(listed)} frames are listed, {len(frames)} were looked at, exit code "
                      f"{read.returncode}: {read.stderr}")
        shutil.rmtree(recording)

    def check_again(self, job_name, job):
        code = start(self.program, self.folder, job).wait()
        words = (self.folder / ".err").read_text()
        if code != 0:
            self.fail(f"{job_name}: the same command again: exit code {code}: {words}")
        self.counts["resumed"] += "finished task" in words
        there = {n: b for n, b in files_of(self.folder).items() if n not in self.inputs}
        if set(there) != set(job.results):
            self.fail(f"{job_name}: after the same command again there are {sorted(there)}")
        for name in set(there) & set(job.results):
            if not self.is_whole(job_name, name, there[name]):
                self.fail(f"{job_name}: {name} is another one after the same command again")

    def round(self, i):
        job_name = list(JOBS)[i % len(JOBS)]
        job = JOBS[job_name]
        # One further with each turn, so that every job meets every signal.
        number = SIGNALS[(i + i // len(JOBS)) % len(SIGNALS)]
        self.signals.add(number)
        had_old = self.random.random() < 0.5
        for name in job.results if had_old else []:
            if name != job.journal:
                (self.folder / name).write_bytes(OLD)
        self.hit(job_name, job, number)
        self.check_after_kill(job_name, job, number, had_old)
        if job.recording:
            self.check_recording(job_name, job, number)
        self.check_again(job_name, job)
        self.clear(job)


def main():
    program, folder = os.path.abspath(sys.argv[1]), Path(sys.argv[2])
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    rounds = Rounds(program, folder, seed)
    for i in range(count):
        rounds.round(i)
    if count >= 10 and len(rounds.signals) < 3:
        rounds.fail(f"only {sorted(rounds.signals)} were sent")
    print(f"{count} rounds: " + ", ".join(f"{n} {what}" for what, n in rounds.counts.items()) +
          f", {len(rounds.failures)} failures")
    shutil.rmtree(folder, ignore_errors=True)
    return 1 if rounds.failures else 0


if __name__ == "__main__":
    sys.exit(main())
