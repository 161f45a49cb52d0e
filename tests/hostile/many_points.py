#!/usr/bin/env python3
"""Names an object of ten million points, as a cloud and as a mesh: time and peak memory of each.

  many_points.py SPINCAT FOLDER [POINTS]

The object is a bumpy ball: a cloud (.ply, three floats a point) and a mesh (.ply) of twice as many triangles as points.
Judges by every preset, judges trained for clouds, and `spin`. Needs a gigabyte in FOLDER and twelve of memory.
"""
import array
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import object_files  # noqa: E402

MODELS = {"default": "", "any": "--for any", "paper": "--preset paper"}
MOST_BYTES_A_POINT = 1_500  # of the process, for meshes with two triangles a point


def head(points, faces):
    return (f"ply\nformat binary_little_endian 1.0\nelement vertex {points}\nproperty float x\nproperty float y\n"
            "property float z\n" +
            (f"element face {faces}\nproperty list uchar int vertex_indices\n" if faces else "") + "end_header\n").encode()


def write_ball(file, points, with_faces):
    """A grid of longitudes and latitudes, row by row: no more than a row is in memory."""
    columns = int(math.sqrt(2 * points))
    rows = points // columns
    faces = 2 * (rows - 1) * columns if with_faces else 0
    with open(file, "wb") as out:
        out.write(head(rows * columns, faces))
        turns = [2 * math.pi * c / columns for c in range(columns)]
        around = [(math.cos(a), math.sin(a), math.sin(5 * a)) for a in turns]
        for r in range(rows):
            height, wide = math.cos(math.pi * (r + 0.5) / rows), math.sin(math.pi * (r + 0.5) / rows)
            bump = 0.1 * math.sin(7 * math.pi * r / rows)
            row = array.array("f")
            for x, y, wave in around:
                size = 1 + bump * wave
                row.extend((wide * x * size, wide * y * size, height * size))
            out.write(row.tobytes())
        for r in range(rows - 1 if with_faces else 0):
            row = bytearray()
            for c in range(columns):
                a, b = r * columns + c, r * columns + (c + 1) % columns
                for face in ((a, b, b + columns), (a, b + columns, a + columns)):
                    row += b"\x03" + b"".join(i.to_bytes(4, "little") for i in face)
            out.write(row)
    return rows * columns


def measured(line, folder):
    begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen(line, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    out, err = process.communicate()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return process.returncode, out, err, time.monotonic() - begin, cpu


def peak_of(line, folder):
    """The largest resident set in kB: a process of its own asks, as the system tells the largest of all children."""
    code = ("import resource, subprocess, sys; "
            "done = subprocess.run(sys.argv[1:], stdout=sys.stdout); "
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=sys.stderr); sys.exit(done.returncode)")
    return measured([sys.executable, "-c", code, *line], folder)


def main():
    program, folder = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).absolute()
    points = int(sys.argv[3]) if len(sys.argv) > 3 else 10_000_000
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    object_files.write_data_set(folder / "shapes", 6)
    for name, options in MODELS.items():
        line = [program, "train", "shapes", "-o", f"{name}.spincat", "--copies", "1", "--background", "4", *options.split()]
        subprocess.run(line, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    count = write_ball(folder / "cloud.ply", points, False)
    write_ball(folder / "mesh.ply", points, True)
    print(f"{count} points; the mesh has as many and twice as many triangles", flush=True)
    failures = 0
    jobs = [(f"{name} judges, {kind}", [program, "classify", f"{name}.spincat", f"{kind}.ply", "--json"])
            for name in MODELS for kind in ("cloud", "mesh")]
    jobs += [(f"spin, {kind}", [program, "spin", f"{kind}.ply", "-o", "x.npy", "--spin-points", "256", "--bin-size",
                                "0.05rel", "--json"]) for kind in ("cloud", "mesh")]
    for what, line in jobs:
        code, out, err, wall, cpu = peak_of(line, folder)
        peak = int(err.split()[-1])
        answer = json.loads(out) if code == 0 else {}
        good = code == 0 and peak * 1024 < MOST_BYTES_A_POINT * count + 200e6 and "NaN" not in str(answer)
        failures += not good
        print(f"{'ok    ' if good else 'FAILED'} {what}: {wall:.1f} s ({cpu:.1f} s of CPU), peak {peak / 1024:.0f} MB, "
              f"{answer.get('category', '')} {'' if good else err.decode()}", flush=True)
    shutil.rmtree(folder, ignore_errors=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
