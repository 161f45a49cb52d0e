"""The estimator: scikit-learn's protocol, labels, probabilities, evidence."""

import copy
import inspect
import os
import pickle
import subprocess
import sys
import unittest

import numpy as np
from support import SMALL, SOURCE, Folder, box, boxes, cloud

import spincat

try:
    from sklearn.base import clone, is_classifier
    from sklearn.model_selection import GridSearchCV, LeaveOneOut, cross_val_predict, cross_val_score
    from sklearn.pipeline import Pipeline
    from sklearn.preprocessing import FunctionTransformer
    from sklearn.utils import estimator_checks
except ImportError:
    clone = None


def turned(objects):
    """Every object on its side."""
    return [spincat.Object(shape.points[:, ::-1], shape.faces) for shape in objects]


@unittest.skipIf(clone is None, "scikit-learn is not installed")
class Protocol(Folder):
    def test_clone_and_parameters(self):
        classifier = spincat.Classifier(c=3, background=8, reject=None)
        again = clone(classifier)
        self.assertEqual(again.get_params(), classifier.get_params())
        self.assertEqual(again.set_params(c=4).c, 4)
        self.assertEqual(classifier.c, 3)
        self.assertTrue(is_classifier(classifier))
        self.assertEqual(repr(classifier), "Classifier(reject=None, c=3, background=8)")

    # check_estimator hands arrays of numbers to fit, which are no objects here: every check that fits, predicts or
    # looks at the shape of X is left out. These are the ones that look at the parameters and the class.
    def test_parameter_checks_of_check_estimator(self):
        classifier = spincat.Classifier()
        for check in ("check_no_attributes_set_in_init", "check_get_params_invariance", "check_set_params"):
            getattr(estimator_checks, check)("Classifier", classifier)
        estimator_checks.check_parameters_default_constructible("Classifier", classifier)
        estimator_checks.check_estimator_get_tags_default_keys("Classifier", classifier)

    def test_cross_validation_and_grid_search(self):
        objects, labels = boxes()
        classifier = spincat.Classifier(**{**SMALL, "background": 0})
        scores = cross_val_score(classifier, objects, labels, cv=2)
        self.assertEqual(scores.tolist(), [1.0, 1.0])
        search = GridSearchCV(classifier, {"c": [1, 10], "image_width": [8, 16]}, cv=2, n_jobs=2).fit(objects, labels)
        self.assertEqual(search.best_score_, 1.0)
        self.assertEqual(search.predict(objects[:1]).tolist(), ["board"])

    def test_pipeline(self):
        objects, labels = boxes()
        chain = Pipeline([("turn", FunctionTransformer(turned)), ("name", spincat.Classifier(**SMALL))])
        self.assertEqual(chain.fit(objects, labels).score(objects, labels), 1.0)
        self.assertEqual(chain.set_params(name__c=2).named_steps["name"].c, 2)

    def test_scores_are_those_of_evaluate(self):
        _, files, labels = self.write_boxes(5)
        # Hardly any points, so that some names are wrong.
        settings = {"background": 0, "copies": 0, "spin_points": 2, "points": 12, "image_width": 8}
        labels = [label if i % 4 else "stick" for i, label in enumerate(labels)]
        splits = spincat.Splits(4, test_share=0.3, seed=3)
        found = spincat.evaluate(files, labels, splits=4, test_share=0.3, seeds=[3], **settings)
        self.assertLess(found.overall_rate.mean, 1.0)
        order = np.argsort([str(file) for file in files])
        files, labels = [files[i] for i in order], [labels[i] for i in order]
        scores = cross_val_score(spincat.Classifier(**settings), files, labels, cv=splits)
        self.assertAlmostEqual(scores.mean(), found.overall_rate.mean, places=12)

    def test_scores_over_the_princeton_furniture(self):
        psb = os.environ.get("SPINCAT_PSB", "")
        if not os.path.isdir(psb):
            self.skipTest("SPINCAT_PSB names no folder")
        settings = {"background": 0, "copies": 0, "trained_for": "meshes", "points": 512, "spin_points": 32, "image_width": 16}
        found = spincat.evaluate(psb, category_map=SOURCE / "data/psb-furniture.csv", splits=2, **settings)
        files, labels = [one[0] for one in found.tested], [one[1] for one in found.tested]
        scores = cross_val_score(spincat.Classifier(**settings), files, labels, cv=spincat.Splits(2))
        self.assertEqual(len(files), 156)
        self.assertAlmostEqual(scores.mean(), found.overall_rate.mean, places=12)

    def test_names_are_those_of_leaving_each_out(self):
        _, files, labels = self.write_boxes(3)
        settings = {**SMALL, "background": 0}
        names = cross_val_predict(spincat.Classifier(**settings), files, labels, cv=LeaveOneOut())
        found = spincat.evaluate(files, labels, leave_one_out=True, **settings)
        self.assertEqual({str(file): [name] for file, name in zip(files, names)}, {one[0]: one[2] for one in found.tested})


class Learning(Folder):
    def test_every_setting_is_a_parameter(self):
        parameters = set(inspect.signature(spincat.Classifier).parameters)
        self.assertEqual(parameters - {"reject", "threads"}, set(spincat.settings()))

    def test_imports_with_numpy_alone(self):
        code = "import sys, spincat; print(sorted(m for m in ('sklearn', 'scipy', 'tqdm') if m in sys.modules))"
        said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(said.stdout.strip(), "[]")

    def test_labels(self):
        objects, labels = boxes(3)
        numbers = {"board": 10, "cube": 9, "stick": -2}
        classifier = spincat.Classifier(**SMALL).fit(objects, [numbers[label] for label in labels])
        self.assertEqual(classifier.classes_.tolist(), [-2, 9, 10])
        self.assertEqual(classifier.predict(objects).tolist(), [numbers[label] for label in labels])
        by_name = spincat.Classifier(**SMALL).fit(objects, np.array(labels, dtype=object))
        self.assertEqual(by_name.predict_proba(objects)[:, [2, 1, 0]].argmax(1).tolist(), classifier.predict_proba(objects).argmax(1).tolist())  # fmt: skip
        self.assertEqual(by_name.score(objects, labels), 1.0)
        self.assertEqual(by_name.score(objects, labels, sample_weight=np.arange(len(labels))), 1.0)
        with self.assertRaisesRegex(spincat.InputError, "unknown"):
            classifier.set_params(reject=1).predict([cloud()])

    def test_probabilities_are_the_confidence(self):
        objects, labels = boxes(3)
        for classifier in (
            spincat.Classifier(**SMALL).fit(objects, labels),
            spincat.Classifier(**SMALL).fit(objects[:6], labels[:6]),
        ):
            shown = [*objects, cloud(), box(1, 0.5, 0.5)]
            ballots = classifier.ballots(shown)
            shares = classifier.predict_proba(shown)
            np.testing.assert_allclose(shares.sum(axis=1), 1, atol=1e-12)
            self.assertEqual(classifier.classes_[shares.argmax(axis=1)].tolist(), classifier.predict(shown).tolist())
            self.assertGreaterEqual(shares.min(), 0)
            for row, ballot in zip(shares, ballots):
                self.assertIn(max(row), (ballot.confidence, np.nextafter(1 / len(row), 1)))
            scores = classifier.decision_function(shown)
            if scores.ndim == 1:
                names = classifier.classes_[(scores > 0).astype(int)]
            else:
                names = classifier.classes_[scores.argmax(axis=1)]
            self.assertEqual(names.tolist(), classifier.predict(shown).tolist())

    def test_probabilities_of_ties(self):
        from spincat import _probabilities

        scores = np.array([[2.0, 2.0, 0.0], [1.0, 1.0, 1.0], [0.0, 2.0, 1.0]])
        shares = _probabilities.with_confidence(scores, np.array([1, 0, 1]), np.array([0.9, 0.1, 0.6]))
        np.testing.assert_allclose(shares.sum(axis=1), 1)
        self.assertEqual(shares.argmax(axis=1).tolist(), [1, 0, 1])
        self.assertEqual(shares[[0, 2], 1].tolist(), [0.9, 0.6])
        self.assertGreater(shares[2, 2], shares[2, 0])

    def test_pickle_and_copy(self):
        objects, labels = boxes(2)
        classifier = spincat.Classifier(**SMALL).fit(objects, labels)
        expected = classifier.predict_proba(objects)
        for again in (pickle.loads(pickle.dumps(classifier)), copy.deepcopy(classifier), copy.copy(classifier)):
            self.assertEqual(again.predict_proba(objects).tobytes(), expected.tobytes())
            self.assertEqual(again.get_params(), classifier.get_params())

    def test_a_loaded_model_can_learn_again(self):
        objects, labels = boxes(2)
        spincat.Classifier(**SMALL, kernel="linear").fit(objects, labels).save(self.folder / "m.spincat")
        loaded = spincat.Classifier.load(self.folder / "m.spincat")
        self.assertEqual((loaded.copies, loaded.background, loaded.draws), (0, 8, None))
        loaded.fit(objects, labels).save(self.folder / "again.spincat")
        self.assertEqual((self.folder / "again.spincat").read_bytes(), (self.folder / "m.spincat").read_bytes())

    def test_a_folder_with_a_damaged_file(self):
        data, _, _ = self.write_boxes(2)
        (data / "stick" / "broken.off").write_text("OFF\n1\n")
        classifier = spincat.Classifier(**SMALL).fit_folder(data)
        self.assertEqual([file for file, _ in classifier.skipped_], [str(data / "stick" / "broken.off")])
        with self.assertRaisesRegex(spincat.InputError, "broken.off: "):
            spincat.Classifier(**SMALL).fit_folder(data, strict=True)


class Ballots(Folder):
    @classmethod
    def setUpClass(cls):
        cls.objects, cls.labels = boxes(3)
        cls.classifier = spincat.Classifier(**SMALL).fit(cls.objects, cls.labels)

    def test_votes_and_margins(self):
        ballot = self.classifier.ballots(self.objects[:1])[0]
        self.assertEqual((ballot.name, ballot.votes["board"]), ("board", 2))
        self.assertEqual(sum(ballot.votes.values()), 3)
        np.testing.assert_array_equal(ballot.margins, -ballot.margins.T)
        np.testing.assert_allclose(ballot.margin_sums, ballot.margins.sum(axis=1), rtol=1e-5)
        self.assertRegex(repr(ballot), r"^<spincat.Ballot: board, confidence 0\.\d\d, runner-up (cube|stick)>$")
        self.assertEqual(ballot.kind_mismatch, "")

    def test_strangers(self):
        strict = spincat.Classifier(**SMALL, reject=1).fit(self.objects, self.labels)
        ballot = strict.ballots([cloud()])[0]
        self.assertTrue(ballot.unknown)
        self.assertEqual(ballot.name, "unknown")
        self.assertIn(ballot.best_guess, self.classifier.classes_)
        self.assertIn("unknown", repr(ballot))
        self.assertEqual(strict.predict([cloud()]).tolist(), ["unknown"])

    def test_shows_in_a_notebook(self):
        page = self.classifier.ballots(self.objects[:1])[0]._repr_html_()
        self.assertTrue(page.startswith("<iframe") and page.endswith("</iframe>"))
        self.assertIn("a model in memory", page)

    def test_evidence_adds_up_to_the_margin(self):
        shape = self.objects[0]
        evidence = self.classifier.explain(shape)
        ballot = self.classifier.ballots([shape])[0]
        self.assertEqual((evidence.winner, evidence.runner_up), (ballot.name, ballot.runner_up))
        self.assertTrue(evidence.adds_up)
        told = sum(float(part.contributions.sum()) for part in evidence.parts)
        self.assertAlmostEqual(told, evidence.margin, places=3)
        self.assertEqual([part.axes for part in evidence.parts], ["normals", "radial", "normals"])
        for part in evidence.parts:
            self.assertEqual(part.points.shape, (48, 3))
            self.assertEqual(part.directions.shape, (48, 3))
            self.assertTrue((part.points <= shape.points.max(axis=0) + 1e-5).all())
            self.assertTrue((part.points >= shape.points.min(axis=0) - 1e-5).all())
