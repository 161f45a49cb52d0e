"""What the tests of the Python package share: small objects, files of them, and the command."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import spincat

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("SPINCAT_COMMAND", "")

# Learns within a second.
SMALL = {"background": 8, "copies": 0, "spin_points": 48, "image_width": 16}
SMALL_OPTIONS = ["--background", "8", "--copies", "0", "--spin-points", "48", "--image-width", "16"]

_CORNERS = np.indices((2, 2, 2)).reshape(3, -1).T.astype(float)
_FACES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]  # fmt: skip
SIZES = {"board": (1.0, 0.9, 0.05), "cube": (1.0, 1.0, 1.0), "stick": (1.0, 0.06, 0.05)}


def box(x, y, z):
    return spincat.Object(_CORNERS * [x, y, z], _FACES)


def boxes(each=4):
    """Boxes of three categories with their labels."""
    objects, labels = [], []
    for name, size in SIZES.items():
        for i in range(each):
            objects.append(box(size[0] + 0.07 * i, size[1], size[2]))
            labels.append(name)
    return objects, labels


def cloud(points=400, seed=1):
    """A noisy sphere, squeezed."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(points, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return spincat.Object(directions * [1.0, 0.8, 0.5] + 0.01 * random.normal(size=(points, 3)))


def sphere(points=300, seed=2):
    """Points with their normals."""
    directions = np.random.default_rng(seed).normal(size=(points, 3))
    return (directions / np.linalg.norm(directions, axis=1, keepdims=True)).astype(np.float32)


def command(*arguments):
    """What the command prints."""
    if not COMMAND:
        raise unittest.SkipTest("SPINCAT_COMMAND is not set")
    done = subprocess.run([COMMAND, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 2):
        raise AssertionError(done.stderr)
    return done.stdout


def command_json(*arguments):
    return [json.loads(line) for line in command(*arguments, "--json", "--quiet").splitlines()]


class Folder(unittest.TestCase):
    """With a folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write_boxes(self, each=4):
        """A data set of boxes: its folder, the files and their labels."""
        files, labels = [], []
        for i, (shape, label) in enumerate(zip(*boxes(each))):
            files.append(self.folder / "boxes" / label / f"{i:02}.ply")
            files[-1].parent.mkdir(parents=True, exist_ok=True)
            spincat.write(shape, files[-1])
            labels.append(label)
        return self.folder / "boxes", files, labels
