"""Spin images of a cloud's points, as the Point Cloud Library makes them, and which points look most alike.

    python3 spin_images.py CLOUD IMAGES.npy

The numbers are those of

    pcl::SpinImageEstimation<pcl::PointXYZ, pcl::Normal, pcl::Histogram<153>> estimation(8, 0.0, 0);
    estimation.setRadiusSearch(radius);

with the same points and normals, to a millionth.
"""

from __future__ import annotations

import sys

import numpy as np

import spincat


def main(cloud: str, target: str) -> None:
    points = spincat.read(cloud).points
    size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    normals = spincat.estimate_normals(points, k=16)
    chosen = np.linspace(0, len(points) - 1, 50).astype(int)  # spread over the file
    images = spincat.spin_images(points, normals, chosen, width=8, radius=0.3 * size, convention="pcl")
    np.save(target, images)
    print(f"{len(images)} spin images of {images.shape[1]} x {images.shape[2]}")

    likeness = np.corrcoef(images.reshape(len(images), -1))
    np.fill_diagonal(likeness, -1)
    one, other = np.unravel_index(likeness.argmax(), likeness.shape)
    print(f"most alike: points {chosen[one]} and {chosen[other]}, correlation {likeness.max():.2f}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (spincat.InputError, spincat.RunError) as problem:
        sys.exit(f"spin_images: {problem}")
