"""Objects to feature vectors, and the settings by which."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _spincat
from ._common import Items, ProgressLike, thread_count, told


def settings(preset: str = "default", **chosen: Any) -> dict[str, Any]:
    """All settings by name: those of a preset ("default" or "paper"), with what is chosen and what that brings.

    Raises InputError for a setting that is not there, out of its range, or without effect beside the others.
    docs/reference/settings.md explains each.

    >>> import spincat
    >>> spincat.settings(kernel="rbf")["c"]
    3.0
    """
    return _spincat.settings(preset, chosen)


def describe(
    objects: Items,
    *,
    preset: str = "default",
    threads: Optional[int] = None,
    progress: ProgressLike = None,
    **settings: Any,
) -> npt.NDArray[np.float32]:
    """Feature vectors of N objects (or files), N x D, float32: the bytes that `spincat describe` writes.

    Takes the settings of points, images and features. `progress` is a function of stage, done and total, or tqdm. The
    same bytes for any number of `threads` (None: all processors). Raises InputError for the first object that cannot be
    read or has no extent.

    >>> import numpy as np, spincat
    >>> cloud = spincat.Object(np.random.default_rng(1).random((300, 3)))
    >>> spincat.describe([cloud], spin_points=32, image_width=16).shape
    (1, 2304)
    """
    return _spincat.describe(objects, preset, settings, thread_count(threads), told(progress))
