// Clouds of far more points than are drawn from them.
#pragma once

#include <cstddef>

#include "spincat/geometry/object.h"

namespace spincat {

// More points than this are thinned: searches for neighbours take their time, and a few thousand points are drawn.
inline constexpr std::size_t kDense = 32'768;

// The cloud where it has no more points than kDense; else the first point in each cell of a grid, whose cells are as
// small as leave no more than kDense of them. The grid's finest cells are a 64th of the distance within which three
// quarters of the points lie from their median, its coarsest a quarter; points beyond twice that distance all stay, so
// that those that stand alone still do. Repeated exact zeros, where a sensor measured nothing, go. What the cloud looks
// like where it is thin does not change. Order, normals and sensor stay; points that go are added to those left out.
// Deterministic. Time grows with the points, and is some 20 ms for a million.
PointCloud without_crowds(const PointCloud& cloud);

}  // namespace spincat
