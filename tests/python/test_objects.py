"""Objects in arrays and files."""

import html
import pickle

import numpy as np
from support import SOURCE, Folder, box, cloud

import spincat


class Arrays(Folder):
    def test_views_are_not_copies_and_cannot_be_written(self):
        cube = box(1, 2, 3)
        self.assertEqual(cube.points.dtype, np.float64)
        self.assertEqual(cube.faces.dtype, np.uint32)
        self.assertEqual(cube.points.ctypes.data, cube.points.ctypes.data)
        with self.assertRaises(ValueError):
            cube.points[0] = 1
        points = cube.points
        del cube
        np.testing.assert_array_equal(points.max(axis=0), [1, 2, 3])

    def test_any_layout_gives_the_same_object(self):
        wide = np.random.default_rng(1).integers(0, 100, (20, 6)).astype(np.float64)
        expected = wide[::2, 1:4].tolist()
        packed = np.zeros(10, dtype=[("skip", "u1"), ("at", "<f8", 3)])
        packed["at"] = wide[::2, 1:4]
        for points in (
            wide[::2, 1:4],
            np.asfortranarray(wide[::2, 1:4]),
            wide[::2, 1:4].astype(np.float32),
            wide[::2, 1:4].astype(np.int16),
            wide[::2, 1:4].astype(">f8"),
            wide[::2, 1:4].astype(np.float16),
            wide[::2, 3:0:-1][:, ::-1],
            packed["at"],
            expected,
        ):
            self.assertEqual(spincat.Object(points).points.tolist(), expected)

    def test_what_it_says(self):
        self.assertEqual(repr(box(1, 1, 1)), "<spincat.Object: mesh of 8 points and 12 faces>")
        self.assertEqual(repr(cloud(30)), "<spincat.Object: cloud of 30 points>")
        self.assertEqual(repr(spincat.Object(np.eye(3), normals=np.eye(3))), "<spincat.Object: cloud of 3 oriented points>")
        self.assertEqual(len(cloud(30)), 30)
        self.assertEqual(box(1, 1, 1).info()["triangles"], 12)
        self.assertIsNone(cloud(30).faces)
        self.assertIsNone(cloud(30).sensor)
        self.assertEqual(spincat.Object(np.eye(3), faces=np.zeros((0, 3), int)).kind, "cloud")

    def test_shows_in_a_notebook(self):
        page = html.unescape(box(1, 1, 1)._repr_html_())
        self.assertTrue(page.startswith("<iframe"))
        self.assertTrue('"triangles":12' in page and page.endswith("</html>\n\"></iframe>"))

    def test_pickles(self):
        oriented = spincat.Object(np.eye(3), normals=2 * np.eye(3), sensor=[0, 0, 9])
        again = pickle.loads(pickle.dumps(oriented))
        np.testing.assert_array_equal(again.normals, 2 * np.eye(3))
        np.testing.assert_array_equal(again.sensor, [0, 0, 9])
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(box(1, 2, 3))).faces, box(1, 2, 3).faces)


class Files(Folder):
    def same(self, shape, name):
        spincat.write(shape, self.folder / name)
        again = spincat.read(self.folder / name)
        self.assertEqual(again.kind, shape.kind)
        for one, other in ((again.points, shape.points), (again.faces, shape.faces), (again.normals, shape.normals), (again.sensor, shape.sensor)):  # fmt: skip
            self.assertEqual(one is None, other is None)
            if one is not None:
                self.assertEqual(one.tobytes(), other.tobytes())

    def test_written_objects_are_read_as_they_were(self):
        random = np.random.default_rng(1)
        points = random.normal(size=(20, 3)) * 10.0 ** random.integers(-30, 30, (20, 1))
        self.same(spincat.Object(points), "a.ply")
        self.same(spincat.Object(points), "a.pcd")
        self.same(spincat.Object(points, normals=random.normal(size=(20, 3))), "b.ply")
        self.same(spincat.Object(points, normals=random.normal(size=(20, 3)), sensor=[0, 0, 0]), "c.pcd")
        self.same(spincat.Object(points, sensor=[0.1, -1e-9, 3]), "d.PCD")
        self.same(spincat.Object(points, random.integers(0, 20, (50, 3))), "e.ply")

    def test_other_names_are_refused(self):
        with self.assertRaisesRegex(spincat.InputError, r"a.obj: expected a name that ends in .ply or .pcd"):
            spincat.write(box(1, 1, 1), self.folder / "a.obj")
        with self.assertRaisesRegex(spincat.InputError, "PCD files hold no faces"):
            spincat.write(box(1, 1, 1), self.folder / "a.pcd")
        with self.assertRaises(spincat.InputError):
            spincat.write(box(1, 1, 1), self.folder / "none" / "a.ply")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_limits(self):
        spincat.write(cloud(50), self.folder / "a.ply")
        with self.assertRaisesRegex(spincat.InputError, "49"):
            spincat.read(self.folder / "a.ply", max_points=49)

    def test_errors_know_the_file(self):
        with self.assertRaises(spincat.InputError) as caught:
            spincat.read(SOURCE / "none.obj")
        self.assertTrue(caught.exception.file.endswith("none.obj"))
        self.assertEqual(str(caught.exception), f"{caught.exception.file}: {caught.exception.problem}")
        self.assertIsInstance(caught.exception, ValueError)


class Normals(Folder):
    def test_of_a_sphere_point_away_from_its_middle(self):
        points = cloud(800).points / [1.0, 0.8, 0.5]
        normals = spincat.estimate_normals(points * 1e12 + 1e13, k=12)
        self.assertEqual(normals.shape, (800, 3))
        self.assertGreater(np.mean((normals * points).sum(axis=1)), 0.95)

    def test_towards_a_place(self):
        points = np.random.default_rng(1).random((50, 3)) * [1, 1, 0]
        for z in (5, -5):
            normals = spincat.estimate_normals(points.astype(np.float32), 8, towards=[0, 0, z])
            np.testing.assert_allclose(normals, np.tile([0, 0, np.sign(z)], (50, 1)), atol=1e-6)
