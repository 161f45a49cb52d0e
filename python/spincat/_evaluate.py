"""Measuring how often names are right."""

from __future__ import annotations

import os
from typing import Any, Iterator, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _spincat
from ._common import Items, Path, ProgressLike, path, paths, real, thread_count, told, whole
from ._files import labelled
from ._spincat import Evaluation, InputError


def evaluate(
    data: Union[Path, Items],
    y: Optional[Sequence[Any]] = None,
    *,
    splits: int = 20,
    test_share: float = 0.2,
    seeds: Sequence[int] = (),
    leave_one_out: bool = False,
    test: Optional[Path] = None,
    test_as: str = "as-is",
    confidence: bool = False,
    fewest_objects: int = 1,
    models: Path = "",
    category_map: Path = "",
    others: Path = "",
    threads: Optional[int] = None,
    progress: ProgressLike = None,
    preset: str = "default",
    **settings: Any,
) -> Evaluation:
    """Measures as `spincat evaluate` does: judges learn from some objects and name the others.

    `data` is a data set (a folder, a CSV or .cla file, or several of them; `models`, `category_map` and `others` as the
    command takes them), or a list of objects with their labels `y`. By default `splits` random splits test the share
    `test_share` of each category, for each of `seeds` (the setting `seed` where there are none); `leave_one_out` tests
    each object by judges of all others, and `test` another data set. `test_as` alters the tested objects, as by
    "cloud" or "turned". Raises InputError as Classifier.fit does.

    >>> import numpy as np, spincat
    >>> random = np.random.default_rng(1)
    >>> boxes = [random.random((200, 3)) * size for size in 4 * [[1, 1, 0.05]] + 4 * [[1, 0.05, 0.05]]]
    >>> found = spincat.evaluate(list(map(spincat.Object, boxes)), 4 * ["board"] + 4 * ["stick"],
    ...                          leave_one_out=True, background=0, copies=0, spin_points=32, image_width=16)
    >>> found.overall_rate.mean
    1.0
    """
    options = {
        "splits": whole("splits", splits),
        "test_share": real("test_share", test_share),
        "seeds": [whole("seeds", seed) for seed in seeds],
        "leave_one_out": bool(leave_one_out),
        "test_as": str(test_as),
        "confidence": bool(confidence),
        "fewest_objects": whole("fewest_objects", fewest_objects),
    }
    if any(seed < 0 for seed in options["seeds"]):  # type: ignore[attr-defined]
        raise InputError("seeds: expected whole numbers from 0")
    work = (options, preset, settings, thread_count(threads), told(progress))
    if y is not None:
        if test is not None or models or category_map or others:
            raise InputError("y: without effect beside test, models, category_map and others, which are of data sets")
        if isinstance(data, (str, os.PathLike)):
            raise InputError("y: expected a list of objects with it")
        with labelled(data, y) as known:
            name = f"{len(known.files)} objects"
            return _spincat.evaluate_files(known.files, known.labels, known.names, name, *work)
    sources = paths("data", data)
    read_as = _spincat.DatasetOptions(
        path("models", models), path("category_map", category_map), path("others", others), ""
    )
    return _spincat.evaluate_sources(sources, read_as, [] if test is None else paths("test", test), *work)


class Splits:
    """The random splits of `evaluate`, for scikit-learn's `cv`: the same ones where objects are sorted by file name.

    Of every category with n objects round(n test_share) are tested, at least 1 and at most n - 1.

    >>> import spincat
    >>> labels = 5 * ["chair"] + 5 * ["table"]
    >>> [(len(train), len(test)) for train, test in spincat.Splits(2).split(labels, labels)]
    [(8, 2), (8, 2)]
    """

    def __init__(self, count: int = 20, *, test_share: float = 0.2, seed: int = 1) -> None:
        self.count = count
        self.test_share = test_share
        self.seed = seed

    def split(
        self, X: Any, y: Any, groups: Any = None
    ) -> Iterator[tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32]]]:
        """Indices to learn from and to test, split by split."""
        labels = np.unique(np.asarray(y), return_inverse=True)[1].tolist()
        seed = whole("seed", self.seed)
        if seed < 0:
            raise InputError(f"seed {seed}: expected a whole number from 0")
        yield from _spincat.splits(labels, whole("count", self.count), real("test_share", self.test_share), seed)

    def get_n_splits(self, X: Any = None, y: Any = None, groups: Any = None) -> int:
        """How many."""
        return self.count

    def __repr__(self) -> str:
        return f"Splits({self.count}, test_share={self.test_share}, seed={self.seed})"
