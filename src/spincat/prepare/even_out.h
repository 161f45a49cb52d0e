// Some of many points, spread evenly over the surface that they were taken from unevenly.
#pragma once

#include <cstddef>

#include "spincat/geometry/random.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {

// Draws `count` points without replacement, each with a probability that falls with the number of points around it (in
// the same cell of edge 0.04 and with a normal in the same octant), so that the result is spread evenly over the
// surface. In random order: the first k of them are themselves such a draw. All points, in random order, when there
// are no more than `count`. Deterministic for one state of `random`.
SurfacePoints even_out(const SurfacePoints& points, std::size_t count, Random& random);

}  // namespace spincat
