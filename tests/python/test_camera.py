"""Frames of a depth camera."""

import os
import pathlib

import numpy as np
from support import SMALL, Folder, boxes

import spincat


def table_with_a_box():
    """240 x 320 depths: a table that the camera looks down at, with a cube of 12 cm on it."""
    v, u = np.mgrid[0:240, 0:320]
    rays = np.stack([(u - 159.5) / 262.5, (v - 119.5) / 262.5, np.ones_like(u, float)], axis=-1)
    down = np.array([0.0, np.sin(0.9), np.cos(0.9)])  # the table is 0.8 m below, along this
    depth = 0.8 / (rays @ down)
    along = np.array([0.0, np.cos(0.9), -np.sin(0.9)])
    middle = np.array([0.0, 0.0, 0.8 / down[2]])  # of its foot, in the middle of the picture
    axes = [np.array([1.0, 0, 0]), along, down]
    near, far = np.full(depth.shape, -np.inf), np.full(depth.shape, np.inf)
    for axis, low, high in zip(axes, (-0.06, -0.06, -0.12), (0.06, 0.06, 0.0)):
        rate = rays @ axis
        low, high = ((bound + middle @ axis) / np.where(rate == 0, 1e-12, rate) for bound in (low, high))
        near, far = np.maximum(near, np.minimum(low, high)), np.minimum(far, np.maximum(low, high))
    depth = np.where(near < far, near, depth)
    return np.where((depth > 0.4) & (depth < 2), depth, 0).astype(np.float32)


class Camera(Folder):
    def setUp(self):
        super().setUp()
        self.classifier = spincat.Classifier(**SMALL).fit(*boxes(2))
        self.camera = (262.5, 262.5, 159.5, 119.5)

    def test_an_object_is_found_and_named(self):
        seeing = spincat.Recogniser(self.classifier, reject=0, threads=2)
        depth = table_with_a_box()
        for i in range(3):
            seen = seeing.frame(depth, self.camera)
            self.assertEqual(seen.status, "objects")
            self.assertEqual([one.id for one in seen.objects], [1])
        one = seen.objects[0]
        self.assertIn(one.name, self.classifier.classes_)
        self.assertEqual(one.frames, 3)
        self.assertAlmostEqual(one.height, 0.12, places=2)
        self.assertEqual(np.count_nonzero(seen.ids == one.segment), one.pixels)
        self.assertEqual(seen.ids.shape, depth.shape)
        self.assertRegex(repr(one), r"<spincat.SeenObject 1: \w+, confidence 0\.\d\d, 1\.\d\d m away>")
        self.assertAlmostEqual(abs(float(seen.table[3])), 0.8, places=2)

    def test_units_layouts_and_matrices(self):
        depth = table_with_a_box()
        matrix = [[262.5, 0, 159.5], [0, 262.5, 119.5], [0, 0, 1]]
        wide = np.zeros((240, 400), np.float64)
        wide[:, 40:360] = depth
        expected = spincat.Recogniser(self.classifier).frame(depth, self.camera)
        for given, unit in ((np.asfortranarray(depth), None), (wide[:, 40:360], None), (depth * np.float32(1024), 1024)):
            seen = spincat.Recogniser(self.classifier).frame(given, matrix, units_per_metre=unit)
            self.assertEqual(seen.ids.tobytes(), expected.ids.tobytes())
        millimetres = spincat.Recogniser(self.classifier).frame((depth * 1000).astype(np.uint16), self.camera)
        self.assertEqual(len(millimetres.objects), 1)

    def test_nothing_to_see(self):
        seeing = spincat.Recogniser(self.classifier)
        self.assertEqual(seeing.frame(np.zeros((48, 64))).status, "few_readings")
        self.assertEqual(seeing.frame(np.full((48, 64), np.nan)).objects, [])
        self.assertEqual(seeing.frame(np.full((480, 640), -1.0)).status, "few_readings")

    def test_damaged_input_is_refused(self):
        seeing = spincat.Recogniser(self.classifier)
        depth = table_with_a_box()
        for words, arguments, more in (
            ("depth: expected an array of shape", (depth[0],), {}),
            ("depth: expected an array of shape", (np.zeros((0, 5)),), {}),
            ("depth: expected 16384 rows and columns at most", (np.broadcast_to(np.float32(1), (10**5, 10**5)),), {}),
            ("depth: expected numbers", (np.full((4, 4), "a"),), {}),
            ("intrinsics: expected", (depth, (1, 2)), {}),
            ("intrinsics: expected", (depth, "kinect"), {}),
            ("fx", (depth, (-1, 1, 1, 1)), {}),
            ("units_per_metre", (depth, self.camera), {"units_per_metre": 0}),
        ):
            with self.assertRaisesRegex(spincat.InputError, words):
                seeing.frame(*arguments, **more)
        for words, more in (
            ("threads", {"threads": 0}),
            ("up", {"up": [0, 0, 0]}),
            ("up", {"up": [0, 1]}),
            ("least share of known 2", {"reject": 2}),
            ("least_area|least area", {"least_area": -5}),
            ("scene", {"scene": "ceiling"}),
            ("summed_frames|frames", {"summed_frames": 0}),
        ):
            with self.assertRaisesRegex(spincat.InputError, words):
                spincat.Recogniser(self.classifier, **more)
        with self.assertRaises(spincat.InputError):
            spincat.frames(self.folder / "none")

    def test_a_recording(self):
        recordings = sorted(pathlib.Path(os.environ.get("SPINCAT_KINECT", self.folder)).glob("kinect-tabletop/*"))
        if not recordings:
            self.skipTest("SPINCAT_KINECT has no recordings")
        for place in recordings:
            if place.is_dir() and list(place.glob("*.png")):
                frame = next(spincat.frames(place))
                self.assertEqual(frame.depth.ndim, 2)
                self.assertEqual(len(frame.intrinsics), 4)
                return
