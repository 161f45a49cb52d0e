// Points of a cloud that are no part of the object: what sensors write for "nothing measured", and points far from all
// others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// Indices of the points that stand alone, ascending. A point's spacing is the distance to its fourth neighbour; a point
// stands alone where its spacing is more than 4 times that of its neighbours (their median) or 3 times that of 95 % of
// all points; at exactly (0, 0, 0), a sensor's word for nothing, 1.5 times that of its neighbours are enough. A scan
// that is dense here and thin there keeps all its points: neighbours are alike. Nothing stands alone among fewer than
// 64 points, or where more than a tenth would: that is how the object was sampled. Deterministic. Precondition: no two
// points at one place.
std::vector<std::uint32_t> lone_points(std::span<const Vec3> points);

// The cloud with each of its points once (the first of those at one place), and without those that stand alone. Where
// several lie at exactly (0, 0, 0), a sensor measured nothing there, and they go, too, unless they are all there is.
// Order, normals and sensor stay; the points that go are added to those left out. Deterministic.
PointCloud without_lone_points(const PointCloud& cloud);

}  // namespace spincat
