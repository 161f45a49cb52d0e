"""The commands that are killed, and how to tell whether what they wrote is whole."""
import random
import re
import struct
import subprocess
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import object_files  # noqa: E402

SMALL = "--points 512 --spin-points 64 --threads 2"


class Job:
    def __init__(self, arguments, results, journal=None, recording=None):
        self.arguments = arguments
        self.results = results  # names of the files that it writes
        self.journal = journal  # what it goes on from; removed at its end, unless it is a result, too
        self.recording = recording  # the folder of frames that it writes, which must not be there before


JOBS = {
    "train": Job(f"train shapes -o x.spincat --journal t.journal --copies 2 {SMALL}", ["x.spincat"], "t.journal"),
    "evaluate": Job(f"evaluate shapes --splits 4 --report e.html --json --journal e.journal --copies 1 --background 4 {SMALL}",
                    ["e.html", "e.confusion.svg", "e.confusion.png"], "e.journal"),
    "spin": Job("spin ball.off -o s.npy --points-output p.npy --journal s.journal --threads 2", ["s.npy", "p.npy"],
                "s.journal"),
    "sheet": Job("spin ball.off -o s.png --sheet 400 --threads 2", ["s.png"]),
    "sweep": Job(f"sweep shapes --vary c=1,10,100 -o w.json --splits 2 --copies 0 --background 4 {SMALL}", ["w.json", "w.json.journal"],
                 "w.json.journal"),
    "camera": Job("camera small.spincat frames --record seen --quiet --threads 1", [], recording="seen"),
}
FRAMES = 200


def depth_png(width, height, rng):
    """A grey 16-bit picture that can hardly be packed."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + struct.pack(f">{width}H", *(rng.randrange(500, 5000) for _ in range(width)))
                    for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_frames(folder):
    folder.mkdir()
    (folder / "camera.txt").write_text("fx 50\nfy 50\ncx 31.5\ncy 23.5\n")
    rng = random.Random(1)
    for k in range(FRAMES):
        (folder / f"{k}.png").write_bytes(depth_png(64, 48, rng))


def listed_frames(recording):
    """The lines of a recording's list; those with an end."""
    file = recording / "depth.txt"
    return file.read_text().split("\n")[:-1] if file.exists() else []


def make_data(folder, program):
    """Objects, frames, and a model, which no command changes."""
    object_files.write_data_set(folder / "shapes", 6)
    (folder / "ball.off").write_bytes(object_files.off(*object_files.lathe(1, 1.5, 0.4, 48, 60)))
    write_frames(folder / "frames")
    subprocess.run([program, *f"train shapes -o small.spincat --copies 0 --background 4 {SMALL}".split()], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)


def lasting(name, data):
    """The part of a result that is the same in every run: pages and tables hold times."""
    if name.endswith((".html", ".json", ".journal")):
        text = re.sub(r" [0-9a-f]{8}$", "", data.decode(), flags=re.MULTILINE)  # checksums of a sweep's lines, of times, too
        return re.sub(r'"([a-z_]*seconds|command)":\s*(\{[^{}]*\}|\[[^\[\]]*\]|[-+.e0-9]+)', "", text)
    return data
