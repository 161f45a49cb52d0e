"""Memory stays what it was over thousands of calls."""

import gc
import unittest

import numpy as np
from support import SMALL, boxes, sphere

import spincat


def resident():
    """Bytes of this process in memory."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


class Leaks(unittest.TestCase):
    def flat(self, work, calls, most=3_000_000):
        for _ in range(calls // 10):
            work()
        gc.collect()
        before = resident()
        for _ in range(calls):
            work()
        gc.collect()
        self.assertLess(resident() - before, most)

    def test_objects(self):
        points = np.random.default_rng(1).random((1000, 3))

        def work():
            shape = spincat.Object(points)
            return shape.points[0], shape.normals, repr(shape)

        self.flat(work, 10_000)

    def test_spin_images(self):
        points = sphere(40)
        self.flat(lambda: spincat.spin_images(points, points, [1, 2], width=8, bin_size=0.1, threads=1), 10_000)

    def test_errors(self):
        def work():
            try:
                spincat.spin_images([[1, 2, np.nan]], [[1, 2, 3]], width=8, bin_size=0.1, threads=1)
            except spincat.InputError:
                pass

        self.flat(work, 10_000)

    def test_answers(self):
        objects, labels = boxes(2)
        classifier = spincat.Classifier(**SMALL, threads=1).fit(objects, labels)
        progress = lambda *_: None  # noqa: E731
        self.flat(lambda: classifier.ballots(objects[:1], progress=progress)[0].margins, 100)


if __name__ == "__main__":
    unittest.main()
