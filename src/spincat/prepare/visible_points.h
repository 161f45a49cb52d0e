// Which points of a cloud can be seen from outside, and from which side.
#pragma once

#include <vector>

#include "spincat/geometry/random.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {

// Points, each standing for a disc across its normal.
struct Discs {
  SurfacePoints points;
  std::vector<double> radii;
};

// What external_surface is to a mesh: the points that the cameras around see, their normals turned to those that see
// them. A disc hides what lies further behind it than its radius. A point that is seen from both sides (a thin board's)
// is there twice, once with each normal, unless one side has less than a quarter of its views; a point that no camera
// sees is left out. Preconditions: the points are normalised (within distance 1 of the origin). Deterministic for one
// state of `random`.
Discs visible_points(const Discs& discs, Random& random);

}  // namespace spincat
