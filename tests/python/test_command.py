"""Everything that the command does gives the same here, byte for byte."""

import numpy as np
from support import SMALL, SMALL_OPTIONS, Folder, boxes, cloud, command, command_json

import spincat


class Command(Folder):
    def write_clouds(self, count=20):
        files = [self.folder / "clouds" / f"{i:02}.pcd" for i in range(count)]
        files[0].parent.mkdir()
        for i, file in enumerate(files):
            spincat.write(cloud(150 + 7 * i, seed=i), file)
        return files

    def test_features(self):
        _, files, _ = self.write_boxes(2)
        files += self.write_clouds()
        for options, settings in ((["--spin-points", 64], {"spin_points": 64}), (["--preset", "paper"], {"preset": "paper"})):
            command("describe", *files, "-o", self.folder / "features.npy", "--quiet", *options)
            expected = np.load(self.folder / "features.npy")
            for threads in (1, 2):
                self.assertEqual(spincat.describe(files, threads=threads, **settings).tobytes(), expected.tobytes())
            objects = [spincat.read(file) for file in files]
            self.assertEqual(spincat.describe(objects, **settings).tobytes(), expected.tobytes())

    def test_models_names_and_confidences(self):
        data, files, labels = self.write_boxes()
        model = self.folder / "command.spincat"
        command("train", data, "-o", model, "--quiet", *SMALL_OPTIONS)
        learned = spincat.Classifier(**SMALL, threads=2).fit_folder(data)
        learned.save(self.folder / "python.spincat")
        self.assertEqual((self.folder / "python.spincat").read_bytes(), model.read_bytes())
        self.assertEqual(learned.skipped_, [])

        files += self.write_clouds()
        said = command_json("classify", model, *files, "--reject", 0, "--votes")
        for classifier in (spincat.Classifier.load(model), learned):
            ballots = classifier.ballots(files)
            self.assertEqual([one["category"] for one in said], classifier.predict(files).tolist())
            self.assertEqual([one["confidence"] for one in said], [ballot.confidence for ballot in ballots])
            self.assertEqual([one["known"] for one in said], [ballot.known for ballot in ballots])
            self.assertEqual([one["votes"] for one in said], [ballot.votes for ballot in ballots])
        for one, ballot in zip(said, ballots):
            for judge in one["judges"]:
                a, b = ballot.categories.index(judge["a"]), ballot.categories.index(judge["b"])
                self.assertEqual(np.float32(judge["margin"]), ballot.margins[a, b])

    def test_the_model_decides_who_is_unknown(self):
        data, files, _ = self.write_boxes()
        model = self.folder / "m.spincat"
        command("train", data, "-o", model, "--quiet", *SMALL_OPTIONS)
        files += self.write_clouds(5)
        said = [one["category"] for one in command_json("classify", model, *files)]
        self.assertEqual(spincat.Classifier.load(model, reject=None).predict(files).tolist(), said)
        self.assertTrue(all(ballot.unknown for ballot in spincat.Classifier.load(model, reject=1).ballots(files)))

    def test_objects_in_memory_learn_as_their_files(self):
        _, files, labels = self.write_boxes()
        by_files = spincat.Classifier(**SMALL).fit(files[::-1], labels[::-1])
        by_memory = spincat.Classifier(**SMALL).fit(*boxes())
        by_files.save(self.folder / "a.spincat")
        by_memory.save(self.folder / "b.spincat")
        self.assertEqual((self.folder / "a.spincat").read_bytes(), (self.folder / "b.spincat").read_bytes())

    def test_rates(self):
        data, files, labels = self.write_boxes()
        settings = {**SMALL, "background": 0}
        options = ["--splits", 3, *SMALL_OPTIONS[2:], "--background", 0]
        said = command_json("evaluate", data, *options)[0]
        found = spincat.evaluate(data, splits=3, **settings)
        self.assertEqual(found.confusion.tolist(), said["confusion"])
        self.assertEqual(found.mean_class_rate.mean, said["mean_class_rate"])
        listed = spincat.evaluate(files, labels, splits=3, **settings)
        self.assertEqual(listed.confusion.tolist(), said["confusion"])
        self.assertIn("</html>", found.html())
        self.assertTrue(found._repr_html_().startswith("<iframe"))
        self.assertRegex(repr(found), r"<spincat.Evaluation: mean-class rate \d\.\d+ ± ")
