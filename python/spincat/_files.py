"""What judges learn from comes from files: objects in memory become temporary ones, with all their digits."""

from __future__ import annotations

import contextlib
import os
import tempfile
from typing import Any, Iterator, NamedTuple

import numpy as np

from . import _spincat
from ._common import Items, path
from ._spincat import InputError, Object


class Labelled(NamedTuple):
    """Objects with their classes, as the library takes them."""

    files: list[str]
    labels: list[int]  # of each: its place in `names`
    names: list[str]  # of the classes, sorted as the library sorts categories
    classes: Any  # an array of the labels as they were given, sorted
    class_of_name: list[int]  # the place of each name's class in `classes`
    order: list[int]  # the place of each file among the objects that were given


def _check_labels(objects: Any, y: Any) -> Any:
    labels = np.asarray(y)
    if labels.ndim == 2 and labels.shape[1] == 1:
        labels = labels[:, 0]
    if labels.ndim != 1 or len(labels) != len(objects):
        raise InputError(f"y: expected a label for each of {len(objects)} objects, found an array of shape {labels.shape}")
    if labels.dtype.kind == "O" and all(isinstance(label, str) for label in labels):
        labels = labels.astype(str)
    if labels.dtype.kind not in "Uiub":
        raise InputError(f"y: expected texts or whole numbers, found values of type {labels.dtype}")
    return labels


@contextlib.contextmanager
def labelled(objects: Items, y: Any) -> Iterator[Labelled]:
    """The objects as files, sorted by their names, while the block lasts. Its errors call objects by their place."""
    if isinstance(objects, (str, bytes, os.PathLike, Object)):
        raise InputError("expected a list of Objects or of file names")
    items = list(objects)
    labels = _check_labels(items, y)
    if not items:
        raise InputError("expected objects to learn from, found none")
    classes, codes = np.unique(labels, return_inverse=True)
    names = [str(one) for one in classes.tolist()]
    by_name = sorted(range(len(names)), key=lambda k: os.fsencode(names[k]))
    place = {k: i for i, k in enumerate(by_name)}
    with tempfile.TemporaryDirectory(prefix="spincat-") as folder:
        files: list[tuple[bool, bytes, int, str]] = []
        for i, item in enumerate(items):
            if isinstance(item, Object):
                name = os.path.join(folder, f"{i}.{'ply' if item.kind == 'mesh' else 'pcd'}")
                _spincat.write(name, item)
                files.append((False, b"", i, name))
            else:
                name = path(f"objects[{i}]", item)
                files.append((True, os.fsencode(name), i, name))
        files.sort()
        order = [i for _, _, i, _ in files]
        try:
            yield Labelled(
                files=[name for _, _, _, name in files],
                labels=[place[int(codes[i])] for i in order],
                names=[names[k] for k in by_name],
                classes=classes,
                class_of_name=by_name,
                order=order,
            )
        except InputError as error:
            if os.path.dirname(error.file) != folder:
                raise
            renamed = InputError(f"objects[{os.path.splitext(os.path.basename(error.file))[0]}]: {error.problem}")
            renamed.problem = error.problem
            raise renamed from None
