// How far the points of a cloud are from each other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// For each point the distance to the `nth` of its nearest neighbours; to the last where there are fewer, and 0 where
// there is none. Deterministic. Precondition: nth >= 1.
std::vector<double> neighbour_distances(std::span<const Vec3> points, std::size_t nth);

}  // namespace spincat
