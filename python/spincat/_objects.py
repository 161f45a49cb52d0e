"""Objects in files, and the points that stand for them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _spincat
from ._common import Item, Path, path, whole
from ._spincat import InputError, Object


def read(
    file: Path, *, max_points: int = 100_000_000, max_triangles: int = 200_000_000, max_growth: int = 20
) -> Object:
    """Reads a mesh or a point cloud from an OFF, OBJ, PLY, STL, PCD, XYZ, glTF, GLB, 3MF, NPY, NPZ, LAS or KITTI file.

    Coordinates are in the file's unit. More than `max_points`, `max_triangles` or, for packed files, `max_growth` bytes
    of memory for each byte are refused. Raises InputError when the file is missing, damaged or of another format.

    >>> import numpy as np, os, spincat, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "cloud.npy")
    >>> np.save(name, np.eye(3))
    >>> spincat.read(name)
    <spincat.Object: cloud of 3 points, cloud.npy>
    """
    limits = [
        whole(name, value)
        for name, value in (
            ("max_points", max_points),
            ("max_triangles", max_triangles),
            ("max_growth", max_growth),
        )
    ]
    if min(limits) < 0:
        raise InputError("max_points, max_triangles and max_growth are 0 or more")
    return _spincat.read(path("file", file), *limits)


def write(shape: Object, file: Path) -> None:
    """Writes an object: a mesh as .ply, a cloud as .ply or .pcd, in double precision, so that read gives it back.

    Where a cloud was seen from is kept by .pcd alone. Raises InputError for another extension, RunError when the file
    cannot be written.

    >>> import numpy as np, os, spincat, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "cloud.ply")
    >>> spincat.write(spincat.Object(np.eye(3)), name)
    >>> np.array_equal(spincat.read(name).points, np.eye(3))
    True
    """
    if not isinstance(shape, Object):
        raise InputError(f"expected an Object to write, found {type(shape).__name__}")
    _spincat.write(path("file", file), shape)


def estimate_normals(
    points: npt.ArrayLike, k: int = 24, towards: Optional[npt.ArrayLike] = None
) -> npt.NDArray[np.float64]:
    """Unit normals of N x 3 points, N x 3: the direction of least spread among the `k` nearest points (3 to 1000).

    They point to the side of `towards` (a place, as the sensor's), or away from the middle of all points. Raises
    InputError when a point is not finite, or all are at one place.

    >>> import numpy as np, spincat
    >>> plane = np.random.default_rng(1).random((50, 3)) * [1, 1, 0]
    >>> normals = spincat.estimate_normals(plane, k=8, towards=[0, 0, 9])
    >>> bool(np.allclose(normals, [0, 0, 1]))
    True
    """
    return _spincat.estimate_normals(points, whole("k", k), towards)


@dataclass(frozen=True, repr=False)
class Prepared:
    """The points that stand for an object, scaled so that the furthest one lies at distance 1 from the middle.

    `points` and `normals` (N x 3, float32) are the surface, `keypoints` (K x 6: positions and normals) the points that
    spin images are of, `bin_size` the size of a bin in this unit. x_file = x / scale + centre.
    """

    points: npt.NDArray[np.float32]
    normals: npt.NDArray[np.float32]
    keypoints: npt.NDArray[np.float32]
    scale: float
    centre: npt.NDArray[np.float64]
    bin_size: float

    def __repr__(self) -> str:
        return f"<spincat.Prepared: {len(self.points)} points, {len(self.keypoints)} keypoints>"


def prepare(shape: Item, *, preset: str = "default", **settings: Any) -> Prepared:
    """Prepares an object (or a file) as `describe` and the command do, by the settings of points and images.

    With them `spin_images` gives the images of the command `spincat spin`, byte for byte. Raises InputError when the
    object has no extent, or a setting is out of its range.

    >>> import numpy as np, spincat
    >>> cloud = spincat.Object(np.random.default_rng(1).random((500, 3)))
    >>> spincat.prepare(cloud, spin_points=10)
    <spincat.Prepared: ... points, 10 keypoints>
    """
    made = _spincat.prepare(shape, preset, settings)
    surface = made["surface"]
    return Prepared(
        points=surface[:, :3],
        normals=surface[:, 3:],
        keypoints=made["keypoints"],
        scale=made["scale"],
        centre=made["centre"],
        bin_size=made["bin_size"],
    )
