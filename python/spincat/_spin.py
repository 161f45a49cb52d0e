"""Spin images of points in arrays."""

from __future__ import annotations

import warnings
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _spincat
from ._common import ProgressLike, real, thread_count, told, whole
from ._spincat import InputError


class DroppedPointsWarning(UserWarning):
    """Points or keypoints had no part: they are not finite, or their normals have no direction.

    `points` and `keypoints` are their indices.
    """

    def __init__(self, points: npt.NDArray[np.int64], keypoints: npt.NDArray[np.int64]) -> None:
        super().__init__(
            f"left out {len(points)} points and {len(keypoints)} keypoints, whose images are NaN: "
            "they are not finite, or their normals have no direction"
        )
        self.points = points
        self.keypoints = keypoints


def _bin_size(width: int, bin_size: Optional[float], radius: Optional[float], convention: str) -> float:
    if (bin_size is None) == (radius is None):
        raise InputError("bin_size or radius: expected one of them")
    if bin_size is not None:
        return real("bin_size", bin_size)
    length = real("radius", radius)
    if not (np.isfinite(length) and length > 0):
        raise InputError(f"radius {length:g}: expected a number above 0")
    return _spincat.pcl_bin_size(length, width) if convention == "pcl" else length / width


def _rows(keypoints: Any) -> Any:
    """Keypoints that are told by a mask or by two arrays, as indices or rows of six numbers."""
    if isinstance(keypoints, tuple) and len(keypoints) == 2:
        positions, normals = (np.asarray(part) for part in keypoints)
        if positions.ndim != 2 or positions.shape != normals.shape:
            raise InputError(
                f"keypoints: expected points and normals of one shape (K, 3), found {positions.shape} and {normals.shape}"
            )
        return np.hstack([positions, normals])
    if isinstance(keypoints, (list, tuple)) and not keypoints:
        return np.empty(0, np.int64)
    if isinstance(keypoints, np.ndarray) and keypoints.dtype == bool:
        return np.flatnonzero(keypoints)
    return keypoints


def spin_images(
    points: npt.ArrayLike,
    normals: npt.ArrayLike,
    keypoints: Any = None,
    *,
    width: int,
    bin_size: Optional[float] = None,
    radius: Optional[float] = None,
    support_angle: Optional[float] = None,
    convention: str = "johnson",
    binning: str = "bilinear",
    angle_test: str = "cutoff",
    threads: Optional[int] = None,
    progress: ProgressLike = None,
) -> npt.NDArray[np.float32]:
    """Spin images of keypoints on a surface of N x 3 points and normals: K x H x W, float32.

    `keypoints` are indices of points, a mask of them, a tuple of points and normals (K x 3 each), or K x 6; None: all
    points. Float32 is used as it is. Float64 that lies more than eight extents from the origin is moved there before it
    is rounded. Normals may have any length.

    convention "johnson": H = W = `width`. A row falls with the height over the tangent plane, a column grows with the
    distance from the normal's line; a point counts within `support_angle` (degrees, 60; 180 switches the test off).
    `binning` is "bilinear" or "nearest". angle_test "soft" gives two channels, K x 2 x W x W, without a support angle.
    convention "pcl": as pcl::SpinImageEstimation, H = width + 1, W = 2 width + 1, each image's sum 1; `support_angle` is
    90 unless given, and at most that.

    `bin_size` is in the unit of the points. `radius` stands for it: PCL's search radius, or, by Johnson's convention,
    the width of the whole image.

    Points that are not finite or whose normals have no direction have no part; the images of such keypoints are NaN,
    and a DroppedPointsWarning tells. The same bytes for any number of `threads` (None: all processors). Raises
    InputError for what cannot be, RunError where the images would not fit into memory.

    >>> import numpy as np, spincat
    >>> points = np.random.default_rng(1).normal(size=(400, 3))
    >>> points /= np.linalg.norm(points, axis=1, keepdims=True)
    >>> spincat.spin_images(points, points, [0, 7], width=8, bin_size=0.2).shape
    (2, 8, 8)
    >>> spincat.spin_images(points, points, [0, 7], width=8, radius=0.5, convention="pcl").shape
    (2, 9, 17)
    """
    bins = whole("width", width)
    if bins < 1:
        raise InputError(f"width {bins}: expected 1 to 256")
    chosen = {"image_width": bins, "convention": convention, "binning": binning, "angle_test": angle_test}
    if support_angle is not None or angle_test != "soft":
        usual = 90.0 if convention == "pcl" else 60.0
        chosen["support_angle"] = usual if support_angle is None else real("support_angle", support_angle)
    images, no_points, no_keypoints = _spincat.spin_images(
        points,
        normals,
        _rows(keypoints),
        chosen,
        _bin_size(bins, bin_size, radius, convention),
        thread_count(threads),
        told(progress),
    )
    if len(no_points) or len(no_keypoints):
        warnings.warn(DroppedPointsWarning(no_points, no_keypoints), stacklevel=2)
    return images
