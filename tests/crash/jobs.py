"""The commands that are killed, and how to tell whether what they wrote is whole."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import object_files  # noqa: E402

SMALL = "--points 512 --spin-points 64 --threads 2"


class Job:
    def __init__(self, arguments, results, journal=None):
        self.arguments = arguments
        self.results = results  # names of the files that it writes
        self.journal = journal  # what it goes on from; removed at its end, unless it is a result, too


JOBS = {
    "train": Job(f"train shapes -o x.spincat --journal t.journal --copies 2 {SMALL}", ["x.spincat"], "t.journal"),
    "evaluate": Job(f"evaluate shapes --splits 4 --report e.html --json --journal e.journal --copies 1 {SMALL}",
                    ["e.html", "e.confusion.svg", "e.confusion.png"], "e.journal"),
    "spin": Job("spin ball.off -o s.npy --points-output p.npy --journal s.journal --threads 2", ["s.npy", "p.npy"],
                "s.journal"),
    "sheet": Job("spin ball.off -o s.png --sheet 400 --threads 2", ["s.png"]),
    "sweep": Job(f"sweep shapes --vary c=1,10,100 -o w.json --splits 2 --copies 0 {SMALL}", ["w.json", "w.json.journal"],
                 "w.json.journal"),
}


def make_data(folder):
    object_files.write_data_set(folder / "shapes", 6)
    (folder / "ball.off").write_bytes(object_files.off(*object_files.lathe(1, 1.5, 0.4, 48, 60)))


def lasting(name, data):
    """The part of a result that is the same in every run: pages and tables hold times."""
    if name.endswith((".html", ".json", ".journal")):
        text = re.sub(r" [0-9a-f]{8}$", "", data.decode(), flags=re.MULTILINE)  # checksums of a sweep's lines, of times, too
        return re.sub(r'"([a-z_]*seconds|command)":\s*(\{[^{}]*\}|\[[^\[\]]*\]|[-+.e0-9]+)', "", text)
    return data
