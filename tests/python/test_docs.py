"""What the documentation shows runs: docstrings, the guide, and the README's lines."""

import doctest
import inspect
import os
import unittest

import numpy as np
from support import SMALL, SOURCE, Folder, box, cloud

import spincat


def joined(*parts):
    """Boxes in one mesh, each at its place."""
    points, faces = [], []
    for size, at in parts:
        one = box(*size)
        faces.append(one.faces + 8 * len(points))
        points.append(one.points + at)
    return spincat.Object(np.vstack(points), np.vstack(faces))


def legs(width, depth, height):
    thick = 0.06
    return [((thick, thick, height), (x, y, 0)) for x in (0, width - thick) for y in (0, depth - thick)]


def chair(i):
    width = 0.5 + 0.02 * i
    seat = [((width, 0.5, 0.06), (0, 0, 0.45)), ((width, 0.06, 0.5 + 0.03 * i), (0, 0.44, 0.5))]
    return joined(*seat, *legs(width, 0.5, 0.45))


def table(i):
    return joined(((1.2 + 0.1 * i, 0.8, 0.05), (0, 0, 0.7)), *legs(1.2 + 0.1 * i, 0.8, 0.7))


def shelf(i):
    boards = [((0.8, 0.3, 0.04), (0, 0, 0.4 * k)) for k in range(4 + i % 2)]
    return joined(*boards, ((0.04, 0.3, 1.7 + 0.05 * i), (0, 0, 0)), ((0.04, 0.3, 1.7 + 0.05 * i), (0.76, 0, 0)))


def made_fast(code):
    """With settings by which learning takes a second instead of a minute."""
    small = ", ".join(f"{name}={value}" for name, value in SMALL.items())
    code = code.replace("Classifier()", f"Classifier({small})")
    return code.replace("Classifier(image_width=16)", "Classifier(image_width=16, background=8, copies=0)")


class Documentation(Folder):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def write_furniture(self):
        for make in (chair, table, shelf):
            for i in range(5):
                file = self.folder / "furniture" / make.__name__ / f"{i}.ply"
                file.parent.mkdir(parents=True, exist_ok=True)
                spincat.write(make(i), file)
        spincat.write(chair(7), "a-new-object.ply")
        spincat.write(cloud(2000), "scan.pcd")

    def run_doctest(self, name, text, **names):
        test = doctest.DocTestParser().get_doctest(text, names, name, name, 0)
        said = []
        doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=said.append)
        self.assertFalse(said, "".join(said))
        return len(test.examples)

    def test_docstrings(self):
        for name in spincat.__all__:
            value = getattr(spincat, name)
            if isinstance(value, str):
                continue
            self.assertTrue(value.__doc__, name)
            found = self.run_doctest(name, inspect.getdoc(value))
            if inspect.isfunction(value) and name != "frames":
                self.assertGreater(found, 0, f"{name} has no example")
            if inspect.isclass(value):
                for member, of in vars(value).items():
                    if not member.startswith("_") and (callable(of) or isinstance(of, property)):
                        self.assertTrue(of.__doc__, f"{name}.{member}")

    def test_guide(self):
        self.write_furniture()
        text = made_fast((SOURCE / "docs/guide/python.md").read_text())
        self.assertGreater(self.run_doctest("python.md", text), 20)

    def test_lines_of_the_readme(self):
        self.write_furniture()
        text = (SOURCE / "README.md").read_text().split("## In Python\n")[1].split("\n## ")[0]
        lines = [line[4:] for line in text.splitlines() if line.startswith("    ") and not line.startswith("    $")]
        names = {"print": lambda *said: self.assertEqual(said[0], "chair")}
        exec(made_fast("\n".join(lines)), names)


if __name__ == "__main__":
    unittest.main()
