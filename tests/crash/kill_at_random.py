#!/usr/bin/env python3
"""Kills the commands that write results at random moments and looks at what is left.

  kill_at_random.py SPINCAT FOLDER [ROUNDS [SEED]]

In turn train, evaluate (JSON, report, journal), spin (.npy and .png) and sweep (journal), ROUNDS times in all; of ten
kills eight are SIGKILL, one is SIGTERM and one SIGINT. After each: every result is what it was before or whole; after a
signal that can be caught, no other file is left and the exit code is 128 + signal; the same command again succeeds,
goes on from its journal, gives the results of a run that nobody disturbed, and leaves nothing beside them.
"""
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from jobs import JOBS, lasting, make_data

OLD = b"a former result\n"
SIGNALS = [signal.SIGKILL] * 8 + [signal.SIGTERM, signal.SIGINT]


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
        self.counts = {"killed": 0, "too late": 0, "old": 0, "new": 0, "leftovers": 0, "resumed": 0}
        self.failures = []
        make_data(folder)
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
            self.clear(job)

    def clear(self, job):
        for name in set(files_of(self.folder)) - self.inputs:
            (self.folder / name).unlink()

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
        number = SIGNALS[i // len(JOBS) % len(SIGNALS)]
        had_old = self.random.random() < 0.5
        for name in job.results if had_old else []:
            if name != job.journal:
                (self.folder / name).write_bytes(OLD)
        self.hit(job_name, job, number)
        self.check_after_kill(job_name, job, number, had_old)
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
    print(f"{count} rounds: " + ", ".join(f"{n} {what}" for what, n in rounds.counts.items()) +
          f", {len(rounds.failures)} failures")
    shutil.rmtree(folder, ignore_errors=True)
    return 1 if rounds.failures else 0


if __name__ == "__main__":
    sys.exit(main())
