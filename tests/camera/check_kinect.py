#!/usr/bin/env python3
"""Plays a Kinect's recording to spincat camera through libfreenect's fakenect.

    check_kinect.py SPINCAT SCRATCH-FOLDER

Fails when the objects of the recorded scene are not in the JSON, or when spincat does anything but say in one line that
there is no Kinect where there is none. Where there is no fakenect, or spincat was built without libfreenect, it says so
and ends with 77, which CTest takes as skipped.
"""

import glob
import json
import math
import os
import shutil
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../report/browser"))

from check_live import FOCAL, HEIGHT, WIDTH, depth_at, write_dataset  # noqa: E402
from pages import spincat  # noqa: E402


def reading(metres):
    """The sensor's 11 bits for a depth."""
    return round(2842.5 * (math.atan(metres / 0.1236) - 1.1863)) if metres > 0 else 2047


def write_dump(folder):
    os.makedirs(folder)
    rows = [[reading(depth_at(u, v)) for u in range(WIDTH)] for v in range(HEIGHT)]
    values = b"".join(b"".join(value.to_bytes(2, "little") * 2 for value in row) * 2 for row in rows)
    names = ["d-%f-%u.pgm" % (1000.0 + k / 30, 500000 + 2000000 * k) for k in range(40)]
    for name in names:
        with open(os.path.join(folder, name), "wb") as file:
            file.write(b"P5 %d %d 65535\n" % (2 * WIDTH, 2 * HEIGHT) + values)
    with open(os.path.join(folder, "INDEX.txt"), "w", encoding="ascii") as file:
        file.write("".join(name + "\n" for name in names))
    with open(os.path.join(folder, "camera.txt"), "w", encoding="ascii") as file:
        file.write("fx %g\nfy %g\ncx %g\ncy %g\n" % (2 * FOCAL, 2 * FOCAL, WIDTH - 0.5, HEIGHT - 0.5))


def check_without_kinect(program, model):
    """In a pipe and on a terminal: exit code 1 and one line, by itself."""
    for terminal in (False, True):
        ours, theirs = os.openpty() if terminal else os.pipe()
        camera = subprocess.Popen([program, "camera", model, "freenect:", "--view", "0"], stdin=subprocess.DEVNULL,
                                  stdout=theirs, stderr=subprocess.PIPE, text=True)
        try:
            errors = camera.communicate(timeout=60)[1]
        except subprocess.TimeoutExpired:
            camera.kill()
            camera.wait()
            print("check_kinect: it does not end without a Kinect (or there is one: unplug it)")
            return False
        finally:
            os.close(theirs)
            os.close(ours)
        if camera.returncode != 1 or errors != "spincat: no Kinect was found\n":
            print("check_kinect: without a Kinect: exit code %d, %s" % (camera.returncode, errors))
            return False
    return True


def main():
    program, scratch = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    library = glob.glob("/usr/lib/*/fakenect/libfreenect.so")
    if not library:
        print("no fakenect here (libfreenect-dev)")
        return 77
    shutil.rmtree(scratch, ignore_errors=True)
    write_dataset(os.path.join(scratch, "shapes"))
    write_dump(os.path.join(scratch, "dump"))
    model = os.path.join(scratch, "model.spincat")
    spincat(program, "train", os.path.join(scratch, "shapes"), "-o", model, "--views", "4", "--points", "256",
            "--spin-points", "32", "--threads", "2")
    camera = subprocess.Popen([program, "camera", model, "freenect:", "--json", "--intrinsics",
                               os.path.join(scratch, "dump", "camera.txt")],
                              env=dict(os.environ, LD_PRELOAD=library[0], FAKENECT_PATH=os.path.join(scratch, "dump")),
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    frames = []
    for line in camera.stdout:
        if line.startswith("{"):  # fakenect prints, too
            frames.append(json.loads(line))
        if len(frames) == 5:
            break
    camera.send_signal(signal.SIGINT)
    errors = camera.communicate(timeout=60)[1]
    if "built without libfreenect" in errors:
        print(errors)
        return 77
    if len(frames) < 5:
        print("check_kinect: %d frames: %s" % (len(frames), errors))
        return 1
    names = sorted(each["fused"]["category"] for each in frames[-1]["objects"])
    if names != ["block & <b>", "pillar"]:
        print("check_kinect: named %s" % json.dumps(frames[-1]))
        return 1
    return 0 if check_without_kinect(program, model) else 1


if __name__ == "__main__":
    sys.exit(main())
