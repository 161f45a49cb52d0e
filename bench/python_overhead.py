#!/usr/bin/env python3
"""What Python costs: spin images of 50,000 points at 1,000 keypoints, from arrays, against the C++ call.

    PYTHONPATH=build/release/python bench/python_overhead.py build/release/bench/spincat_python_overhead

Calls of both take turns; the table has the median of each and of their differences.
"""

import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

import spincat

POINTS, KEYPOINTS, ROUNDS, REPEATS = 50_000, 1_000, 9, 5


def surface():
    """An ellipsoid's points with their normals, float32."""
    directions = np.random.default_rng(1).normal(size=(POINTS, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    normals = directions / [1.0, 0.8, 0.6]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return (directions * [1.0, 0.8, 0.6]).astype(np.float32), normals.astype(np.float32)


def in_cpp(program, file, threads):
    arguments = [program, file, POINTS, KEYPOINTS, REPEATS, threads]
    done = subprocess.run(list(map(str, arguments)), capture_output=True, text=True, check=True)
    return min(map(float, done.stdout.split()))


def in_python(points, normals, chosen, threads):
    took = []
    for _ in range(REPEATS):
        begin = time.perf_counter()
        spincat.spin_images(points, normals, chosen, width=20, bin_size=0.05, threads=threads)
        took.append(1e3 * (time.perf_counter() - begin))
    return min(took)


def main(program):
    points, normals = surface()
    chosen = np.arange(KEYPOINTS)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "points"
        file.write_bytes(np.hstack([points, normals]).astype(np.float32).tobytes())
        print("threads   C++ (ms)   Python (ms)   more")
        for threads in (1, 2):
            pairs = [(in_cpp(program, file, threads), in_python(points, normals, chosen, threads)) for _ in range(ROUNDS)]
            cpp, python = np.median(pairs, axis=0)
            more = np.median([after / before - 1 for before, after in pairs])
            print(f"{threads:7}   {cpp:8.2f}   {python:11.2f}   {100 * more:.1f} %")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
