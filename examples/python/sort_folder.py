"""Sorts the objects of a folder into one folder a category; what belongs to none goes to "unknown".

    python3 sort_folder.py MODEL FOLDER SORTED
"""

from __future__ import annotations

import pathlib
import shutil
import sys

import spincat

EXTENSIONS = {".off", ".obj", ".ply", ".stl", ".pcd", ".xyz", ".gltf", ".glb", ".3mf", ".npy", ".npz", ".las"}


def main(model: str, folder: str, target: str) -> None:
    classifier = spincat.Classifier.load(model, reject=None)  # the model decides what is unknown
    files = sorted(file for file in pathlib.Path(folder).rglob("*") if file.suffix.lower() in EXTENSIONS)
    for file in files:
        try:
            ballot = classifier.ballots([file])[0]
        except spincat.InputError as error:  # this file is no use, the next one may be
            print(error, file=sys.stderr)
            continue
        place = pathlib.Path(target) / ballot.name
        place.mkdir(parents=True, exist_ok=True)
        shutil.copy2(file, place)
        print(f"{file.name}: {ballot.name} (confidence {ballot.confidence:.2f}, runner-up {ballot.runner_up})")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (spincat.InputError, spincat.RunError) as problem:
        sys.exit(f"sort_folder: {problem}")
