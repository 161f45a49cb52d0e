"""Learns categories of 3D objects by spin images, and names new ones.

    classifier = spincat.Classifier().fit_folder("furniture")
    classifier.predict(["chair.obj"])

Everything is deterministic: the same input, settings and seed give the same bytes, for any number of threads, and those
of the command `spincat`. Long work leaves Python's lock alone, tells its progress and ends at Ctrl-C.

Objects are meshes or point clouds, in any unit. Where a function takes objects, it takes names of files as well. Bad
input is an InputError (a ValueError), whatever else fails a RunError (a RuntimeError).
"""

from ._camera import Box3D, Frame, Recogniser, SeenFrame, SeenObject, frames
from ._classifier import Classifier, Evidence, EvidencePart
from ._describe import describe, settings
from ._evaluate import Splits, evaluate
from ._objects import Prepared, estimate_normals, prepare, read, write
from ._spin import DroppedPointsWarning, spin_images
from ._spincat import Ballot, Evaluation, InputError, Object, Rate, RunError, __version__

__all__ = [
    "Ballot",
    "Box3D",
    "Classifier",
    "DroppedPointsWarning",
    "Evaluation",
    "Evidence",
    "EvidencePart",
    "Frame",
    "InputError",
    "Object",
    "Prepared",
    "Rate",
    "Recogniser",
    "RunError",
    "SeenFrame",
    "SeenObject",
    "Splits",
    "__version__",
    "describe",
    "estimate_normals",
    "evaluate",
    "frames",
    "prepare",
    "read",
    "settings",
    "spin_images",
    "write",
]
