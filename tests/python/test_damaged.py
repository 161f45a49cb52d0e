"""Damaged input never ends the interpreter: it is refused, in words."""

import threading
import time
import os
import signal
import unittest

import numpy as np
from support import SMALL, Folder, box, boxes, cloud, sphere

import spincat

HUGE = np.broadcast_to(np.int64(0), 10**9)  # takes no memory
POINTS = sphere(50)


def images(points=POINTS, normals=POINTS, keypoints=None, **more):
    return spincat.spin_images(points, normals, keypoints, **{"width": 8, "bin_size": 0.1, **more})


class Refused(Folder):
    def refuse(self, words, function, *arguments, error=spincat.InputError, **more):
        with self.subTest(words):
            with self.assertRaisesRegex(error, words):
                function(*arguments, **more)

    def test_objects(self):
        make = spincat.Object
        self.refuse(r"points: expected one point or more, found none", make, np.zeros((0, 3)))
        self.refuse(r"points: expected an array of shape \(N, 3\), found an array of shape \(3,\)", make, [1, 2, 3])
        self.refuse(r"points: expected an array of shape \(N, 3\), found an array of shape \(2, 2\)", make, np.eye(2))
        self.refuse(r"points: expected an array of shape \(N, 3\), found NoneType", make, None)
        self.refuse(r"points: row 1 is not finite", make, [[0, 0, 0], [0, np.nan, 0]])
        self.refuse(r"points: row 0 is not finite", make, np.full((2, 3), np.inf, np.float32))
        self.refuse(r"points: expected numbers, found values of type complex", make, np.eye(3, dtype=complex))
        self.refuse(r"points: expected numbers, found values of type", make, [["a", "b", "c"]])
        self.refuse(r"points: ", make, [[1, 2, 3], [1, 2]])
        self.refuse(r"points: ", make, object())
        self.refuse(r"faces: row 0 names point 3; points are 0 to 2", make, np.eye(3), [[0, 1, 3]])
        self.refuse(r"faces: row 0 names point -1", make, np.eye(3), [[0, 1, -1]])
        self.refuse(r"faces: expected whole numbers", make, np.eye(3), [[0.0, 1, 2]])
        self.refuse(r"faces: expected an array of shape \(M, 3\)", make, np.eye(3), [[0, 1, 2, 0]])
        self.refuse(r"normals: expected one for each of 3 points, found 2", make, np.eye(3), normals=np.eye(3)[:2])
        self.refuse(r"normals and sensor are of point clouds", make, np.eye(3), [[0, 1, 2]], np.eye(3))
        self.refuse(r"sensor: expected three numbers", make, np.eye(3), sensor=[1, 2])
        self.refuse(r"sensor: is not finite", make, np.eye(3), sensor=[1, 2, np.nan])

    def test_files(self):
        self.refuse("no such file", spincat.read, self.folder / "none.ply")
        self.refuse("is a folder", spincat.read, self.folder)
        self.refuse("expected the name of a file, found int", spincat.read, 7)
        self.refuse("zero byte", spincat.read, "a\0.ply")
        with open(self.folder / "closed.ply", "w") as closed:
            pass
        self.refuse("expected the name of a file", spincat.read, closed)
        self.refuse("is empty", spincat.read, closed.name)
        self.refuse("expected an Object to write", spincat.write, "a", self.folder / "a.ply")
        self.refuse("expected a whole number", spincat.read, closed.name, max_points=1.5)
        self.refuse("0 or more", spincat.read, closed.name, max_points=-1)
        self.refuse("is not a spincat file", spincat.Classifier.load, closed.name)
        if os.path.exists("/dev/full"):
            model = spincat.Classifier(**SMALL).fit(*boxes(2))
            self.refuse("", model.save, "/dev/full", error=spincat.RunError)

    def test_spin_images(self):
        for threads in (0, -1, 10**6):
            self.refuse(f"threads {threads}: expected 1 to", images, threads=threads)
        self.refuse("threads", images, threads=10**30)
        self.refuse("threads 'two': expected a whole number", images, threads="two")
        for width in (-1, 0, 257):
            self.refuse(f"{width}: expected 1 to 256", images, width=width)
        self.refuse("expected a whole number", images, width=8.5)
        for size in (0, -1.0, np.nan, np.inf):
            self.refuse("bin_size|bin size", images, bin_size=size)
            self.refuse("radius", images, bin_size=None, radius=size)
        self.refuse("expected one of them", images, radius=1.0)
        self.refuse("expected one of them", images, bin_size=None)
        self.refuse("expected a number", images, bin_size="wide")
        self.refuse("convention", images, convention="open3d")
        self.refuse("support_angle", images, support_angle=181)
        self.refuse("support.angle", images, support_angle=91, convention="pcl")
        self.refuse("binning", images, binning="cubic")
        self.refuse("progress: expected a function", images, progress=3)
        self.refuse("normals: expected one for each of 50 points, found 49", images, normals=POINTS[:49])
        self.refuse("points: expected an array of shape", images, points=POINTS[:, :2])
        self.refuse("points: expected one point or more that is finite", images, points=np.zeros((0, 3)), normals=np.zeros((0, 3)))  # fmt: skip
        self.refuse("points: expected one point or more that is finite", images, points=np.full((50, 3), np.nan))
        self.refuse("keypoints: 50 is no index of 50 points", images, keypoints=[50])
        self.refuse("keypoints: -1 is no index", images, keypoints=[-1])
        self.refuse("keypoints: expected indices", images, keypoints=[0.5])
        self.refuse("keypoints: expected an array of shape", images, keypoints=np.zeros((4, 3)))
        self.refuse("keypoints: expected", images, keypoints=3)
        self.refuse("keypoints: expected", images, keypoints="all")
        self.refuse("keypoints: expected points and normals", images, keypoints=(POINTS, POINTS[:3]))

    def test_a_thousand_million_keypoints(self):
        self.refuse("spin images: would take .* GB, and the machine has", images, keypoints=HUGE, width=40, error=spincat.RunError)  # fmt: skip
        many = np.broadcast_to(np.float32(0), (10**9, 3))
        self.refuse("would take", images, points=many, normals=many, width=40, error=spincat.RunError)

    def test_settings(self):
        self.refuse("no preset|preset", spincat.settings, "best")
        self.refuse("setting", spincat.settings, widht=3)
        self.refuse("points -1: expected 1 to", spincat.settings, points=-1)
        self.refuse("copies", spincat.describe, [cloud()], copies=3)
        self.refuse("points", spincat.settings, points=[1, 2])
        self.refuse("threads 0: expected 1 to", spincat.describe, [cloud()], threads=0)
        self.refuse("threads -1: expected 1 to", spincat.Classifier(threads=-1, **SMALL).fit, *boxes(2))

    def test_lists_of_objects(self):
        self.refuse("expected one object or more, found none", spincat.describe, [])
        self.refuse("expected a list of Objects", spincat.describe, "chair.obj")
        self.refuse("expected a list of Objects", spincat.describe, cloud())
        self.refuse("expected a list of Objects", spincat.describe, 7)
        self.refuse(r"objects\[1\]: expected an Object or the name of a file, found float", spincat.describe, [cloud(), 1.0])
        self.refuse(r"objects\[1\]: ", spincat.describe, [cloud(), spincat.Object(np.zeros((5, 3)))])
        self.refuse("none.ply: no such file", spincat.describe, [cloud(), self.folder / "none.ply", "gone.ply"])
        self.refuse("no extent|same|one place", spincat.estimate_normals, np.zeros((5, 3)))
        self.refuse("neighbours 2: expected 3 to", spincat.estimate_normals, np.eye(3), 2)

    def test_learning(self):
        objects, labels = boxes(2)
        fit = spincat.Classifier(**SMALL).fit
        self.refuse("y: expected a label for each of 6 objects", fit, objects, labels[:5])
        self.refuse("two or more categories", fit, objects, 6 * ["board"])
        self.refuse("found none", fit, [], np.array([], str))
        self.refuse("y: expected texts or whole numbers", fit, objects, [0.5] * 6)
        self.refuse("expected a list of Objects", fit, "folder", ["a"])
        self.refuse(r"objects\[2\]: expected the name of a file", fit, [*objects[:2], None, *objects[3:]], labels)
        flat = spincat.Object(np.zeros((5, 3)))
        self.refuse(r"^objects\[2\]: ", fit, [*objects[:2], flat, *objects[3:]], labels)
        self.refuse("none.ply: no such file", fit, [*objects[:5], self.folder / "none.ply"], labels)
        self.refuse("no parameter of Classifier", spincat.Classifier().set_params, widht=3)
        self.refuse("has learned nothing", spincat.Classifier().predict, objects)
        self.refuse("reject", spincat.Classifier(reject=2, **SMALL).fit(objects, labels).predict, objects)
        self.refuse("no such file|missing", spincat.Classifier().fit_folder, self.folder / "none")
        self.refuse("splits 0", spincat.evaluate, objects, labels, splits=0)
        self.refuse("form 'sideways' is not known", spincat.evaluate, objects, labels, test_as="sideways")

    def test_nobody_is_reached_after_a_refusal(self):
        """The same call works afterwards."""
        with self.assertRaises(spincat.InputError):
            images(threads=0)
        self.assertEqual(images().shape, (50, 8, 8))


class Interrupted(unittest.TestCase):
    def interrupt(self, work):
        """Sends Ctrl-C as soon as the work is under way. Whether it ended by it."""
        begun = threading.Event()

        def send():
            begun.wait(30)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=send)
        thread.start()
        try:
            work(lambda *_: begun.set())
        except KeyboardInterrupt:
            return True
        finally:
            begun.set()
            thread.join()
        return False

    def test_ctrl_c_ends_long_work(self):
        points = sphere(60_000)
        objects, labels = boxes(40)
        self.assertTrue(self.interrupt(lambda told: spincat.spin_images(points, points, width=40, bin_size=0.05, progress=told)))
        self.assertTrue(self.interrupt(lambda told: spincat.describe(20 * objects, progress=told)))
        self.assertTrue(self.interrupt(lambda told: spincat.Classifier().fit(objects, labels, progress=told)))

    def test_what_progress_raises_arrives(self):
        def stop(*_):
            raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            spincat.describe(boxes(4)[0], progress=stop)
        with self.assertRaisesRegex(LookupError, "enough"):
            spincat.Classifier(**SMALL).fit(*boxes(4), progress=stop)

    def test_other_threads_run_meanwhile(self):
        counted = [0]
        done = threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        spincat.describe(20 * boxes(4)[0], threads=1)
        during = counted[0]
        done.set()
        thread.join()
        self.assertGreater(during, 20)

    def test_several_threads_may_call(self):
        classifier = spincat.Classifier(**SMALL).fit(*boxes(2))
        objects, _ = boxes(3)
        names = [None] * 4

        def name(k):
            names[k] = classifier.predict(objects).tolist()

        threads = [threading.Thread(target=name, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(names, 4 * [names[0]])

    def test_tqdm_is_driven(self):
        class Bar:  # as tqdm.tqdm
            made = []

            def __init__(self, total=None, desc=None):
                self.total, self.desc, self.n, self.closed = total, desc, 0, False
                self.made.append(self)

            def update(self, n=1):
                self.n += n

            def close(self):
                self.closed = True

        spincat.Classifier(**SMALL).fit(*boxes(2), progress=Bar)
        self.assertEqual([bar.desc for bar in Bar.made][0], "describing objects")
        self.assertTrue(all(bar.n == bar.total and bar.closed for bar in Bar.made))
        bar = Bar()
        spincat.describe(boxes(2)[0], progress=bar)
        self.assertEqual((bar.n, bar.total), (6, 6))


if __name__ == "__main__":
    unittest.main()
