"""Learning and naming, by scikit-learn's protocol."""

from __future__ import annotations

import copyreg
import inspect
import os
import tempfile
from dataclasses import dataclass
from typing import Any, Iterable, Optional, Sequence, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _probabilities, _spincat
from ._common import Item, Items, Path, ProgressLike, path, paths, real, thread_count, told
from ._files import labelled
from ._spincat import Ballot, InputError, Model

_Self = TypeVar("_Self", bound="Classifier")
_NO_SETTINGS = ("preset", "reject", "threads")


@dataclass(frozen=True, repr=False)
class EvidencePart:
    """K spin points of one part of the features and what each says.

    `points` (K x 3) are in the object's unit, `directions` (K x 3) the axes of their images, which are "normals",
    "radial" or one of x, y and z (`axes`). `contributions` (K) are above 0 where a point speaks for the winner.
    """

    axes: str
    points: npt.NDArray[np.float64]
    directions: npt.NDArray[np.float32]
    contributions: npt.NDArray[np.float32]

    def __repr__(self) -> str:
        return f"<spincat.EvidencePart: {len(self.contributions)} spin points, axes {self.axes}>"


@dataclass(frozen=True, repr=False)
class Evidence:
    """Where on an object the evidence for its name lies, against the runner-up.

    `margin` is what the judge of these two says, above 0 for the winner. Where `adds_up`, all contributions together
    are the margin; else each is by how much it falls when the point is left out.
    """

    winner: str
    runner_up: str
    margin: float
    adds_up: bool
    parts: list[EvidencePart]

    def __repr__(self) -> str:
        return f"<spincat.Evidence: {self.winner} against {self.runner_up}, margin {self.margin:.2f}>"


class Classifier:
    """Learns categories from objects and names new ones, as `spincat train` and `spincat classify` do.

    An estimator by scikit-learn's protocol, which need not be installed: lists of objects or of file names take the
    place of arrays of features. Arguments are settings (None: the preset's value; spincat.settings() lists them, and
    docs/reference/settings.md explains each), and besides

    reject   predict says "unknown" of objects that are less known than this; 0 names everything, None is the model's
             own limit, which it learns from `background`
    threads  None: all processors that this process may use; results do not depend on it

    Learned attributes: `classes_` (n, sorted), `model_`, and `skipped_` (file and reason of what fit_folder left out).

    >>> import numpy as np, spincat
    >>> random = np.random.default_rng(1)
    >>> boxes = [random.random((200, 3)) * size for size in 4 * [[1, 1, 0.05]] + 4 * [[1, 0.05, 0.05]]]
    >>> objects = list(map(spincat.Object, boxes))
    >>> small = spincat.Classifier(background=0, copies=0, spin_points=32, image_width=16)
    >>> small.fit(objects, 4 * ["board"] + 4 * ["stick"]).predict(objects[3:5]).tolist()
    ['board', 'stick']
    """

    _estimator_type = "classifier"

    def __init__(
        self,
        *,
        preset: str = "default",
        reject: Optional[float] = 0.0,
        threads: Optional[int] = None,
        surface: Optional[str] = None,
        orientation: Optional[str] = None,
        points: Optional[int] = None,
        spin_points: Optional[int] = None,
        neighbours: Optional[int] = None,
        convention: Optional[str] = None,
        image_width: Optional[int] = None,
        bin_size: Union[float, str, None] = None,
        bin_size_unit: Optional[str] = None,
        support_angle: Optional[float] = None,
        binning: Optional[str] = None,
        angle_test: Optional[str] = None,
        encoding: Optional[str] = None,
        radial: Optional[bool] = None,
        plain_samples: Optional[bool] = None,
        up: Optional[str] = None,
        draws: Optional[int] = None,
        words: Optional[int] = None,
        kernel: Optional[str] = None,
        dimensions: Optional[int] = None,
        c: Optional[float] = None,
        class_weights: Optional[bool] = None,
        copies: Optional[int] = None,
        trained_for: Optional[str] = None,
        views: Optional[int] = None,
        background: Optional[int] = None,
        stretch: Optional[float] = None,
        seed: Optional[int] = None,
    ) -> None:
        self.preset = preset
        self.reject = reject
        self.threads = threads
        self.surface = surface
        self.orientation = orientation
        self.points = points
        self.spin_points = spin_points
        self.neighbours = neighbours
        self.convention = convention
        self.image_width = image_width
        self.bin_size = bin_size
        self.bin_size_unit = bin_size_unit
        self.support_angle = support_angle
        self.binning = binning
        self.angle_test = angle_test
        self.encoding = encoding
        self.radial = radial
        self.plain_samples = plain_samples
        self.up = up
        self.draws = draws
        self.words = words
        self.kernel = kernel
        self.dimensions = dimensions
        self.c = c
        self.class_weights = class_weights
        self.copies = copies
        self.trained_for = trained_for
        self.views = views
        self.background = background
        self.stretch = stretch
        self.seed = seed

    # Learning.

    def fit(self: _Self, X: Items, y: Sequence[Any], *, progress: ProgressLike = None) -> _Self:
        """Learns from objects or files and the category of each, a text or a whole number.

        The order of files does not matter. Raises InputError when an object cannot be read, settings are out of range or
        there are fewer than two categories. `progress` is a function of stage, done and total, or tqdm.
        """
        with labelled(X, y) as known:
            name = f"{len(known.files)} objects"
            model, _ = _spincat.train_files(
                known.files, known.labels, known.names, name, *self._work(), told(progress)
            )
        self._learned(model, known.classes, known.class_of_name)
        self.skipped_: list[tuple[str, str]] = []
        return self

    def fit_folder(
        self: _Self,
        folder: Union[Path, Sequence[Path]],
        *,
        models: Path = "",
        category_map: Path = "",
        others: Path = "",
        all: bool = False,
        strict: bool = False,
        progress: ProgressLike = None,
    ) -> _Self:
        """Learns from a data set as `spincat train` does: a folder with one folder a category, a CSV or .cla file.

        The objects of an official test split are held back unless `all`. What cannot be read is listed in `skipped_`,
        or is an InputError where the work is `strict`. The model is the command's, byte for byte.
        """
        options = _spincat.DatasetOptions(
            path("models", models), path("category_map", category_map), path("others", others), ""
        )
        sources = paths("folder", folder)
        model, skipped = _spincat.train_sources(
            sources, options, bool(all), bool(strict), *self._work(), told(progress)
        )
        self._set_model(model)
        self.skipped_ = skipped
        return self

    def save(self, file: Path) -> None:
        """Writes the model file that the command reads, too. Whole numbers as labels become texts there."""
        self.model_.write(path("file", file))

    @classmethod
    def load(
        cls: type[_Self], file: Path, *, reject: Optional[float] = 0.0, threads: Optional[int] = None
    ) -> _Self:
        """Reads a model file of `save` or of the command, whose settings become this one's.

        Raises InputError when it is missing, damaged, of a newer version, or no model.
        """
        model = _spincat.read_model(path("file", file))
        preset = model.settings["preset"]
        usual = _spincat.settings(preset, {})
        chosen = {name: value for name, value in model.settings.items() if value != usual[name]}
        classifier = cls(preset=preset, reject=reject, threads=threads, **chosen)
        classifier._set_model(model)
        return classifier

    # Naming.

    def ballots(self, X: Items, *, progress: ProgressLike = None) -> list[Ballot]:
        """The votes on each object: every judge's margin, confidence, and how known it is.

        Raises InputError for the first object that cannot be read or has no extent.
        """
        model = self.model_
        reject = model.least_known if self.reject is None else real("reject", self.reject)
        return model.classify(X, reject, thread_count(self.threads), told(progress))

    def predict(self, X: Items, *, progress: ProgressLike = None) -> npt.NDArray[Any]:
        """The category of each object, N labels. With `reject` some may be "unknown", where labels are texts."""
        ballots = self.ballots(X, progress=progress)
        labels = self.classes_[self._winners(ballots)]
        if not any(ballot.unknown for ballot in ballots):
            return np.asarray(labels)
        if self.classes_.dtype.kind != "U":
            raise InputError("reject: 'unknown' is no label beside whole numbers; use texts as labels")
        return np.array(["unknown" if ballot.unknown else str(label) for ballot, label in zip(ballots, labels)])

    def decision_function(self, X: Items) -> npt.NDArray[np.float64]:
        """N x n: votes for each category, and a third of a vote at most for the sum of its judges' margins.

        Of two categories N numbers, above 0 for the second.
        """
        scores = self._scores(self.ballots(X))
        return scores[:, 1] - scores[:, 0] if len(self.classes_) == 2 else scores

    def predict_proba(self, X: Items) -> npt.NDArray[np.float64]:
        """N x n, each row's sum 1: the winner's is its calibrated confidence (1 / n at least).

        The others share the rest by their votes and margins.
        """
        ballots = self.ballots(X)
        confidences = np.array([ballot.confidence for ballot in ballots], dtype=np.float64)
        return _probabilities.with_confidence(self._scores(ballots), self._winners(ballots), confidences)

    def score(self, X: Items, y: Sequence[Any], sample_weight: Optional[npt.ArrayLike] = None) -> float:
        """The share of objects that are named right: accuracy."""
        right = self.predict(X) == np.asarray(y)
        return float(np.average(right, weights=sample_weight))

    def explain(self, shape: Item) -> Evidence:
        """What each spin point of an object says for its name, against the runner-up."""
        found = self.ballots([shape])[0].explain()
        parts = [EvidencePart(**part) for part in found.pop("parts")]
        return Evidence(parts=parts, **found)

    # scikit-learn's protocol.

    @classmethod
    def _names(cls) -> list[str]:
        parameters = inspect.signature(cls.__init__).parameters.values()
        return [one.name for one in parameters if one.kind is inspect.Parameter.KEYWORD_ONLY]

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The arguments of the constructor by name."""
        return {name: getattr(self, name) for name in self._names()}

    def set_params(self: _Self, **params: Any) -> _Self:
        """Changes arguments of the constructor. Raises InputError for others."""
        names = self._names()
        for name in params:
            if name not in names:
                raise InputError(f"{name}: no parameter of Classifier; there are {', '.join(names)}")
        for name, value in params.items():
            setattr(self, name, value)
        return self

    def __sklearn_is_fitted__(self) -> bool:
        return "model_" in self.__dict__

    def __sklearn_tags__(self) -> Any:
        # Asked for by scikit-learn 1.6 and later alone, which therefore is there.
        from sklearn.utils import ClassifierTags, InputTags, Tags, TargetTags  # type: ignore[import]

        return Tags(
            estimator_type="classifier",
            target_tags=TargetTags(required=True),
            classifier_tags=ClassifierTags(),
            input_tags=InputTags(two_d_array=False, string=True),
        )

    def _more_tags(self) -> dict[str, Any]:
        return {"X_types": ["string"], "no_validation": True, "requires_y": True}

    def __repr__(self) -> str:
        usual = {name: one.default for name, one in inspect.signature(type(self).__init__).parameters.items()}
        changed = [
            f"{name}={value!r}"
            for name, value in self.get_params().items()
            if not (value is usual[name] or value == usual[name])
        ]
        return f"Classifier({', '.join(changed)})"

    def __getattr__(self, name: str) -> Any:
        if name in ("model_", "classes_"):
            raise _NotFitted("this Classifier has learned nothing; call fit, fit_folder or load")
        raise AttributeError(f"Classifier has no attribute {name!r}")

    def _work(self) -> tuple[str, dict[str, Any], int]:
        chosen = {name: value for name, value in self.get_params().items() if name not in _NO_SETTINGS}
        return str(self.preset), chosen, thread_count(self.threads)

    def _set_model(self, model: Model) -> None:
        names = model.categories
        self._learned(model, np.array(names), list(range(len(names))))

    def _learned(self, model: Model, classes: Any, class_of_name: list[int]) -> None:
        self.model_ = model
        self.classes_: npt.NDArray[Any] = classes
        self._class_of_name = np.array(class_of_name)

    def _winners(self, ballots: Iterable[Ballot]) -> npt.NDArray[np.int64]:
        place = {name: int(k) for name, k in zip(self.model_.categories, self._class_of_name)}
        return np.array([place[ballot.best_guess] for ballot in ballots], dtype=np.int64)

    def _scores(self, ballots: Sequence[Ballot]) -> npt.NDArray[np.float64]:
        by_name = np.zeros((len(ballots), len(self.classes_)))
        for row, ballot in zip(by_name, ballots):
            sums = ballot.margin_sums.astype(np.float64)
            row[:] = list(ballot.votes.values()) + sums / (3 * (np.abs(sums) + 1))
        scores = np.empty_like(by_name)
        scores[:, self._class_of_name] = by_name
        return scores


class _NotFitted(InputError, AttributeError):
    """Nothing is learned yet."""


# Models are pickled as the bytes of their files.


def _model_of(content: bytes) -> Model:
    with tempfile.TemporaryDirectory(prefix="spincat-") as folder:
        name = os.path.join(folder, "model.spincat")
        with open(name, "wb") as file:
            file.write(content)
        return _spincat.read_model(name)


def _reduce(model: Model) -> tuple[Any, tuple[bytes]]:
    with tempfile.TemporaryDirectory(prefix="spincat-") as folder:
        name = os.path.join(folder, "model.spincat")
        model.write(name)
        with open(name, "rb") as file:
            return _model_of, (file.read(),)


copyreg.pickle(Model, _reduce)
