"""Names the objects on a table, frame after frame of a depth camera: here of a recording, a folder of depth pictures.

    python3 depth_camera.py MODEL RECORDING

A driver's frames go the same way: hand its array of depths and its intrinsics to frame().
"""

from __future__ import annotations

import sys

import spincat


def main(model: str, recording: str) -> None:
    recogniser = spincat.Recogniser(model, reject=0.2)  # best learned with views
    for depth, intrinsics, name, _ in spincat.frames(recording):
        seen = recogniser.frame(depth, intrinsics)
        print(f"{name}: {seen.status}, {len(seen.objects)} objects")
        for one in seen.objects:
            said = one.problem or f"{one.name} (confidence {one.confidence:.2f})"
            print(f"  object {one.id} at {one.distance:.2f} m: {said}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (spincat.InputError, spincat.RunError) as problem:
        sys.exit(f"depth_camera: {problem}")
