"""Frames of a depth camera."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator, NamedTuple, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _spincat
from ._classifier import Classifier
from ._common import Path, path, real, thread_count, whole
from ._spincat import InputError

_KINECT = (525.0, 525.0, 319.5, 239.5)
_MILLIMETRES = 1000.0


class Frame(NamedTuple):
    """A frame of a recording: H x W depths in metres (0: not read), (fx, fy, cx, cy) in pixels, name and seconds."""

    depth: npt.NDArray[np.float32]
    intrinsics: tuple[float, float, float, float]
    name: str
    time: float


class Box3D(NamedTuple):
    """A box that stands upright on the table, in metres in the camera's frame."""

    centre: npt.NDArray[np.float32]
    axes: npt.NDArray[np.float32]  # a row each: the longer side along the table, the shorter, up
    size: npt.NDArray[np.float32]  # along the axes


@dataclass(frozen=True, repr=False)
class SeenObject:
    """An object on the table. `name` and what follows are over its last frames; where it could not be named, `problem`
    says why and `name` is ''."""

    id: int  # the same from frame to frame
    segment: int  # its pixels in SeenFrame.ids
    pixels: int
    box: tuple[int, int, int, int]  # left, top, right, bottom, in pixels, inclusive
    centre: npt.NDArray[np.float32]  # of its points, in metres in the camera's frame
    box3d: Box3D  # around what is seen of it
    height: float  # over the table, in metres
    distance: float  # from the camera, in metres
    cut: bool  # touches the picture's border
    problem: str
    name: str = ""
    best_guess: str = ""
    confidence: float = 0.0
    known: float = 0.0
    frames: int = 0

    def __repr__(self) -> str:
        said = self.problem or f"{self.name}, confidence {self.confidence:.2f}"
        return f"<spincat.SeenObject {self.id}: {said}, {self.distance:.2f} m away>"


@dataclass(frozen=True, repr=False)
class SeenFrame:
    """What is seen in a frame. `status` is "objects", "empty_table", "no_table", "few_readings" or "wrong_units";
    `table` the plane n . x + d = 0 as (nx, ny, nz, d) in metres and `outline` the corners of what is seen of it; `ids` says for each pixel which segment it is of."""

    status: str
    median_depth: float
    table: Optional[npt.NDArray[np.float32]]
    outline: npt.NDArray[np.float32]  # N x 3
    ids: npt.NDArray[np.uint16]
    objects: list[SeenObject]

    def __repr__(self) -> str:
        return f"<spincat.SeenFrame: {self.status}, {len(self.objects)} objects>"


def _camera(intrinsics: Any) -> tuple[float, float, float, float]:
    if intrinsics is None:
        return _KINECT
    try:
        numbers = np.asarray(intrinsics, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError("intrinsics: expected (fx, fy, cx, cy) or a 3 x 3 matrix") from None
    if numbers.shape == (3, 3):
        numbers = numbers[[0, 1, 0, 1], [0, 1, 2, 2]]
    if numbers.shape != (4,):
        raise InputError(f"intrinsics: expected (fx, fy, cx, cy) or a 3 x 3 matrix, found shape {numbers.shape}")
    fx, fy, cx, cy = numbers.tolist()
    return fx, fy, cx, cy


class Recogniser:
    """Names the objects on a table, frame after frame, by a Classifier or a model file (best learned with `views`).

    `up` is what is up in the camera's frame (x right, y down, z forward), where it is known. Objects that are less known
    than `reject` are called "unknown" (None: the model's choice). `split` parts what touches along grooves. Things
    stand on what `scene` says: "table", the highest plane that is seen well, "floor", the lowest, or "auto", the plane
    with most readings or a table well seen over it. Objects show the camera `least_area` square metres or more and reach
    `least_height` metres over the table, and nothing above `most_height` is looked at. Votes are summed over `summed_frames`. What it says depends on the frames so far, and neither on the
    number of threads nor on the clock.
    """

    def __init__(
        self,
        model: Union[Classifier, Path],
        *,
        up: Optional[Sequence[float]] = None,
        reject: Optional[float] = None,
        split: bool = False,
        scene: str = "auto",
        least_area: float = 0.0004,
        least_height: float = 0.015,
        most_height: float = 2.0,
        summed_frames: int = 30,
        threads: Optional[int] = None,
    ) -> None:
        classifier = model if isinstance(model, Classifier) else Classifier.load(model)
        wanted = {
            "up": None if up is None else [real("up", one) for one in up],
            "reject": None if reject is None else real("reject", reject),
            "split": bool(split),
            "scene": str(scene),
            "least_area": real("least_area", least_area),
            "least_height": real("least_height", least_height),
            "most_height": real("most_height", most_height),
            "summed_frames": whole("summed_frames", summed_frames),
        }
        if up is not None and len(up) != 3:
            raise InputError("up: expected three numbers")
        self._seeing = _spincat.Recogniser(classifier.model_, wanted, thread_count(threads))

    def frame(
        self, depth: npt.ArrayLike, intrinsics: Any = None, *, units_per_metre: Optional[float] = None
    ) -> SeenFrame:
        """Looks at H x W depths along the optical axis; 0, negative and NaN count as not read.

        `intrinsics` are (fx, fy, cx, cy) or the 3 x 3 matrix, in pixels; None: a Kinect's. Whole numbers are
        millimetres and others metres unless `units_per_metre` is given. Raises InputError for other shapes.
        """
        depths = np.asarray(depth)
        usual = _MILLIMETRES if depths.dtype.kind in "iu" else 1.0
        unit = usual if units_per_metre is None else real("units_per_metre", units_per_metre)
        seen = self._seeing.frame(depths, _camera(intrinsics), unit)
        return SeenFrame(
            status=seen["status"],
            median_depth=seen["median_depth"],
            table=seen["table"],
            outline=seen["outline"],
            ids=seen["ids"],
            objects=[SeenObject(box3d=Box3D(*one.pop("box3d")), **one) for one in seen["objects"]],
        )


def frames(recording: Path) -> Iterator[Frame]:
    """The frames of a recording: a folder of depth pictures (PNG) or organized PCD files, or one such file.

    Raises InputError where there is no frame, and where one cannot be read; the next one may be asked for then.
    """
    return map(Frame._make, _spincat.Recording(path("recording", recording)))
