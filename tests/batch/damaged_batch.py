#!/usr/bin/env python3
"""Names a folder of objects, 5 % of which are damaged, in every way of running, and compares what is said.

  damaged_batch.py SPINCAT FOLDER [FILES [MODES [SEED]]]

MODES is a list of serial, threads, ranks2 and ranks3 (default: all); ranks are left out, with a word, where there is no
mpirun. In each: every good object is named once, every bad one is reported once by its name, in one line, and the
summary and the exit code (2) are right; all modes say the same. Memory: the largest resident set over a tenth of the
files and over all of them, of the serial run, may differ by 4 MB and 2 kB a file; there is never more than one open
file a thread besides the three streams, and their number does not grow.
"""
import json
import os
import random
import re
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import object_files  # noqa: E402

MPIRUN = ("mpirun.openmpi --oversubscribe --bind-to none -n {}").format
DAMAGES = ["truncated", "bytes", "empty", "extension", "folder", "unreadable"]


def bad_bytes(kind, extension, data, rng):
    """The damaged file's extension and bytes, so damaged that no reader could make sense of them."""
    if kind == "truncated":  # text formats may end anywhere; these end within what they need
        return extension, data[:min(len(data) // 2, 60)] if extension not in ("xyz", "obj", "pcd") else data[:5]
    if kind == "bytes":
        return extension, bytes(rng.randrange(128, 256) for _ in range(200))
    if kind == "extension":  # and the first word: a file that plainly is of another format is read as that
        return ("glb", b"glTF" + data) if extension != "glb" else ("ply", b"ply\n" + data)
    return extension, b""


def write_bad(folder, name, kind, extension, data, rng):
    extension, data = bad_bytes(kind, extension, data, rng)
    file = folder / f"{name}.{extension}"
    if kind == "folder":
        file.mkdir()
    elif kind == "unreadable":  # for root, too
        file.symlink_to(folder / "nowhere")
    else:
        file.write_bytes(data)
    return file


def make_files(folder, count, rng):
    """Names of good and of bad files, in one folder and one below it."""
    good, bad = [], []
    shapes = [object_files.box(1, 1, 1), object_files.lathe(0.5, 1, 0.05, 16, 4), object_files.lathe(0.5, 1, 1, 24, 20),
              object_files.lathe(0.1, 2, 1, 12, 60)]
    kinds = list(object_files.FORMATS)
    for i in range(count):
        part = folder / ("deep" if i % 3 == 0 else "flat")
        part.mkdir(parents=True, exist_ok=True)
        extension = kinds[i % len(kinds)]
        mesh = object_files.grown(rng.choice(shapes), [rng.uniform(0.5, 2) for _ in range(3)])
        data = object_files.FORMATS[extension](*mesh)
        if i % 20 == 7:
            bad.append(write_bad(part, f"{i:05}", DAMAGES[i // 20 % len(DAMAGES)], extension, data, rng))
        else:
            good.append(part / f"{i:05}.{extension}")
            good[-1].write_bytes(data)
    return good, bad


class Watch(threading.Thread):
    """The largest resident set (kB) of a process, and its open files after a while and at the end."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self.pid, self.peak, self.files = pid, 0, []

    def run(self):
        while True:
            try:
                for line in Path(f"/proc/{self.pid}/status").read_text().splitlines():
                    if line.startswith("VmHWM"):
                        self.peak = max(self.peak, int(line.split()[1]))
                self.files.append(len(os.listdir(f"/proc/{self.pid}/fd")))
            except (OSError, ProcessLookupError):
                return
            time.sleep(0.01)


class Batch:
    def __init__(self, program, folder, count, seed):
        self.program, self.folder, self.failures = program, folder, []
        make = random.Random(seed)
        object_files.write_data_set(folder / "shapes", 6)
        small = ["--copies", "0", "--background", "4", "--points", "256", "--spin-points", "32"]
        subprocess.run([program, "train", "shapes", "-o", "x.spincat", *small], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        good, bad = make_files(folder / "batch", count, make)
        self.good = [str(f.relative_to(folder)) for f in good]
        self.bad = [str(f.relative_to(folder)) for f in bad]
        # Folders stand for what is below them: one that is called like a file has to be named.
        self.named = [f for f in self.bad if (folder / f).is_dir()]

    def fail(self, text):
        self.failures.append(text)
        print("FAILED:", text[:2000], flush=True)

    def run(self, mode, inputs):
        line = [self.program, "classify", "x.spincat", *inputs, "--json", "--threads", "2" if mode == "threads" else "1"]
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        if mode.startswith("ranks"):
            line = MPIRUN(int(mode[5:])).split() + line
        with open(self.folder / "out", "wb") as out, open(self.folder / "err", "wb") as err:
            process = subprocess.Popen(line, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=err)
            watch = Watch(process.pid)
            watch.start()
            code = process.wait()
            watch.join()
        return code, (self.folder / "out").read_text(), (self.folder / "err").read_text(), watch

    def check(self, mode, code, out, err):
        answers = [json.loads(line) for line in out.splitlines()]
        names = [a["file"] for a in answers if "category" in a]
        reported = [a["file"] for a in answers if "error" in a]
        if sorted(names) != sorted(self.good):
            self.fail(f"{mode}: good ones named: {len(names)}; wrong: {sorted(set(names) ^ set(self.good))[:9]}")
        if sorted(reported) != sorted(self.bad):
            self.fail(f"{mode}: bad ones reported: {len(reported)}; wrong: {sorted(set(reported) ^ set(self.bad))[:9]}")
        lines = [line for line in err.splitlines() if line.startswith("spincat: ")]
        summary = f"spincat: {len(self.bad)} of {len(self.good) + len(self.bad)} objects could not be named"
        if summary not in lines or code != 2:
            self.fail(f"{mode}: exit code {code}, summary {lines[-3:]}")
        for file in self.bad:
            told = [line for line in lines if file + ":" in line]
            if len(told) > 1:
                self.fail(f"{mode}: reported {len(told)} times: {file}")


def open_files_grew(watch):
    """Whether the fewest open files of the last quarter are more than those of the second: one being read is no leak."""
    quarter = len(watch.files) // 4
    return quarter > 2 and min(watch.files[-quarter:-1]) > min(watch.files[quarter:2 * quarter])


def without_times(text):
    return re.sub(r'"milliseconds":\s*(\{[^{}]*\}|[-+.e0-9]+)', "", text)


def main():
    program, folder = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).absolute()
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 10_000
    modes = (sys.argv[4] if len(sys.argv) > 4 else "serial,threads,ranks2,ranks3").split(",")
    seed = int(sys.argv[5]) if len(sys.argv) > 5 else 1
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    batch = Batch(program, folder, count, seed)
    print(f"{len(batch.good)} good and {len(batch.bad)} bad files", flush=True)
    first = None
    peaks = {}
    for mode in modes:
        if mode.startswith("ranks") and shutil.which("mpirun.openmpi") is None:
            print(f"{mode}: left out, there is no mpirun.openmpi")
            continue
        code, out, err, watch = batch.run(mode, ["batch", *batch.named])
        batch.check(mode, code, out, err)
        said = (without_times(out), code)
        first = first or said
        if said != first:
            batch.fail(f"{mode}: not the same bytes as {modes[0]}")
        if not mode.startswith("ranks"):
            peaks[mode] = watch.peak
            if open_files_grew(watch):
                batch.fail(f"{mode}: open files grew: {watch.files[::100]}")
            most = 3 + (2 if mode == "threads" else 1)
            if max(watch.files, default=0) > most:
                batch.fail(f"{mode}: {max(watch.files)} open files, more than {most}")
        print(f"{mode}: exit code {code}, peak {watch.peak} kB, at most {max(watch.files, default=0)} open files",
              flush=True)
    tenth = [f for f in batch.good if "deep" in f][:count // 10]
    _, _, _, watch = batch.run("serial", tenth)
    print(f"serial, {len(tenth)} of the files: peak {watch.peak} kB")
    if "serial" in peaks and peaks["serial"] > watch.peak + 4096 + 2 * count:
        batch.fail(f"memory grew from {watch.peak} to {peaks['serial']} kB")
    shutil.rmtree(folder, ignore_errors=True)
    return 1 if batch.failures else 0


if __name__ == "__main__":
    sys.exit(main())
