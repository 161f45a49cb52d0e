"""The examples, run as a user runs them."""

import struct
import subprocess
import sys
import unittest
import zlib

import numpy as np
from support import SMALL, SOURCE, Folder, boxes, cloud
from test_camera import table_with_a_box

import spincat

EXAMPLES = SOURCE / "examples/python"


def run(name, *arguments, status=0):
    done = subprocess.run([sys.executable, "-B", EXAMPLES / name, *map(str, arguments)], capture_output=True, text=True, check=False)  # fmt: skip
    if done.returncode != status:
        raise AssertionError(done.stdout + done.stderr)
    return done.stdout if status == 0 else done.stderr


def png(depth):
    """A grey picture of 16 bits, depths in millimetres."""
    rows = np.round(depth * 1000).astype(">u2")
    piece = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))  # noqa: E731
    head = struct.pack(">IIBBBBB", depth.shape[1], depth.shape[0], 16, 0, 0, 0, 0)
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    return b"\x89PNG\r\n\x1a\n" + piece(b"IHDR", head) + piece(b"IDAT", zlib.compress(lines)) + piece(b"IEND", b"")


class Examples(Folder):
    def model(self):
        model = self.folder / "boxes.spincat"
        spincat.Classifier(**SMALL).fit(*boxes(2)).save(model)
        return model

    def test_sort_folder(self):
        data, files, labels = self.write_boxes(1)
        (data / "broken.off").write_text("OFF\n1\n")
        out = run("sort_folder.py", self.model(), data, self.folder / "sorted")
        self.assertEqual(out.count("confidence"), 3)
        placed = {file.name: file.parent.name for file in (self.folder / "sorted").glob("*/*")}
        self.assertEqual(set(placed), {file.name for file in files})
        for file, label in zip(files, labels):
            self.assertIn(placed[file.name], (label, "unknown"))
        self.assertRegex(run("sort_folder.py", "none.spincat", data, data, status=1), "^sort_folder: none.spincat: ")

    def test_spin_images(self):
        spincat.write(cloud(), self.folder / "cloud.ply")
        out = run("spin_images.py", self.folder / "cloud.ply", self.folder / "images.npy")
        self.assertRegex(out, r"^50 spin images of 9 x 17\nmost alike: points \d+ and \d+, correlation (0\.\d\d|1\.00)\n$")
        self.assertEqual(np.load(self.folder / "images.npy").shape, (50, 9, 17))

    def test_pipeline(self):
        try:
            import sklearn  # noqa: F401
        except ImportError:
            raise unittest.SkipTest("scikit-learn is not installed") from None
        data, _, _ = self.write_boxes(4)
        out = run("pipeline.py", data, "image_width=16", "spin_points=48")
        self.assertRegex(out, r"^spincat: [01]\.\d+ with \{.*\}\nlogistic regression on its features: [01]\.\d+\n$")

    def test_depth_camera(self):
        frames = self.folder / "frames"
        frames.mkdir()
        for i in range(2):
            (frames / f"{i}.png").write_bytes(png(table_with_a_box()))
        (frames / "camera.txt").write_text("262.5 262.5 159.5 119.5\n")
        out = run("depth_camera.py", self.model(), frames)
        self.assertRegex(out, r"^0.png: objects, 1 objects\n  object 1 at 1\.\d\d m: \w+ \(confidence \d\.\d\d\)\n1.png: ")
