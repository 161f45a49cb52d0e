"""Spin images against PCL, the command and each other."""

import warnings

import numpy as np
from support import SOURCE, Folder, cloud, command, sphere

import spincat


def golden():
    """Points with normals, and the cases (width, radius, degrees, images) that PCL 1.13 made of them."""
    words = iter((SOURCE / "tests/data/spin/pcl_golden.txt").read_text().split())
    take = lambda count: np.array([next(words) for _ in range(count)], dtype=np.float64)  # noqa: E731
    next(words)
    surface = take(6 * int(next(words))).reshape(-1, 6)
    cases = []
    for _ in words:  # the word "case"
        width, radius, degrees, count = int(next(words)), float(next(words)), float(next(words)), int(next(words))
        cases.append((width, radius, degrees, take(count * (width + 1) * (2 * width + 1)).reshape(count, width + 1, -1)))
    return surface, cases


class Pcl(Folder):
    def test_images_of_pcl_to_a_millionth(self):
        surface, cases = golden()
        self.assertEqual(len(cases), 4)
        for width, radius, degrees, expected in cases:
            for kind in (np.float32, np.float64):
                points, normals = surface[:, :3].astype(kind), surface[:, 3:].astype(kind)
                images = spincat.spin_images(
                    points, normals, range(len(expected)), width=width, radius=radius, support_angle=degrees, convention="pcl"
                )  # fmt: skip
                np.testing.assert_allclose(images, expected, rtol=0, atol=1e-6)

    def test_ninety_degrees_unless_given(self):
        points = sphere()
        usual = spincat.spin_images(points, points, [3], width=6, radius=1.0, convention="pcl")
        same = spincat.spin_images(points, points, [3], width=6, radius=1.0, convention="pcl", support_angle=90)
        self.assertEqual(usual.tobytes(), same.tobytes())
        self.assertAlmostEqual(float(usual.sum()), 1.0, places=5)


class Command(Folder):
    def images_of(self, file, *options):
        command("spin", file, "-o", self.folder / "images.npy", "--quiet", *options)
        return np.load(self.folder / "images.npy")

    def test_bytes_of_the_command(self):
        for i in range(4):
            file = self.folder / f"{i}.ply"
            spincat.write(cloud(150 + i, seed=i), file)
            made = spincat.prepare(file, preset="paper", support_angle=180, bin_size="1res")
            for threads in (1, 3):
                images = spincat.spin_images(made.points, made.normals, width=20, bin_size=made.bin_size, support_angle=180, threads=threads)  # fmt: skip
                self.assertEqual(images.tobytes(), self.images_of(file).tobytes())

    def test_bytes_of_the_command_at_chosen_points(self):
        file = self.folder / "a.ply"
        spincat.write(cloud(), file)
        made = spincat.prepare(file, spin_points=17)
        images = spincat.spin_images(made.points, made.normals, made.keypoints, width=40, bin_size=made.bin_size, binning="nearest", angle_test="soft")  # fmt: skip
        self.assertEqual(images.shape, (17, 2, 40, 40))
        wanted = ["--surface", "external", "--orientation", "outward", "--binning", "nearest", "--angle-test", "soft"]
        theirs = self.images_of(file, *wanted, "--image-width", 40, "--bin-size", "0.05rel", "--spin-points", 17)
        self.assertEqual(images.tobytes(), theirs.tobytes())


class Keypoints(Folder):
    def setUp(self):
        super().setUp()
        self.points = sphere()
        self.all = self.images()

    def images(self, keypoints=None, points=None, normals=None, **more):
        points = self.points if points is None else points
        normals = points if normals is None else normals
        return spincat.spin_images(points, normals, keypoints, width=8, bin_size=0.1, **more)

    def test_by_index_mask_and_own_points(self):
        mask = np.zeros(len(self.points), bool)
        mask[[4, 9]] = True
        six = np.hstack([self.points, self.points])[[4, 9]]
        for keypoints in ([4, 9], np.array([4, 9], np.uint8), mask, six, six.astype(np.float64), (six[:, :3], six[:, 3:])):
            self.assertEqual(self.images(keypoints).tobytes(), self.all[[4, 9]].tobytes())
        self.assertEqual(self.images([]).shape, (0, 8, 8))
        own = np.array([[0.0, 0, 0, 0, 0, 1]])
        self.assertEqual(self.images(own).shape, (1, 8, 8))

    def test_the_same_bytes_from_any_array_and_on_any_threads(self):
        wide = np.zeros((len(self.points), 7), np.float32)
        wide[:, 2:5] = self.points
        for points in (np.asfortranarray(self.points), wide[:, 2:5], self.points.astype(np.float64), self.points.tolist()):
            self.assertEqual(self.images(points=points, normals=self.points).tobytes(), self.all.tobytes())
        for threads in (1, 2, 5):
            self.assertEqual(self.images(threads=threads).tobytes(), self.all.tobytes())

    def test_far_from_the_origin(self):
        far = self.points.astype(np.float64) + [1e7, -2e7, 5e6]
        images = self.images(points=far, normals=self.points)
        self.assertLess(np.abs(images - self.all).sum() / self.all.sum(), 1e-3)

    def test_normals_of_any_length(self):
        longer = self.images(normals=self.points.astype(np.float64) * 3e30)
        self.assertLess(np.abs(longer - self.all).sum() / self.all.sum(), 1e-3)

    def test_radius_is_the_width_of_the_image(self):
        by_radius = spincat.spin_images(self.points, self.points, width=8, radius=0.8)
        self.assertEqual(by_radius.tobytes(), self.all.tobytes())

    def test_what_is_dropped_is_told(self):
        points, normals = self.points.copy(), self.points.copy()
        points[5, 1] = np.nan
        normals[7] = 0
        normals[8, 0] = np.inf
        with self.assertWarns(spincat.DroppedPointsWarning) as caught:
            images = self.images([4, 5, 7, 9], points=points, normals=normals)
        self.assertEqual(caught.warning.points.tolist(), [5, 7, 8])
        self.assertEqual(caught.warning.keypoints.tolist(), [1, 2])
        self.assertEqual(np.isnan(images).all(axis=(1, 2)).tolist(), [False, True, True, False])
        kept = np.delete(np.arange(len(points)), [5, 7, 8])
        without = spincat.spin_images(points[kept], normals[kept], [4, 6], width=8, bin_size=0.1)
        self.assertEqual(images[[0, 3]].tobytes(), without.tobytes())

    def test_nothing_is_told_where_nothing_is_dropped(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.images([1])

    def test_progress(self):
        told = []
        self.images(progress=lambda *update: told.append(update))
        self.assertEqual(told[-1], ("making spin images", 300, 300))
