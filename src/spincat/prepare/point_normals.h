// Normals of points that have only neighbours.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "spincat/geometry/object.h"

#pragma GCC visibility push(default)
namespace spincat {

// The unit normal of each point: the direction of least spread among its nearest `neighbours` points, itself included
// (principal component analysis). It points to the side of `towards`, or away from the middle of all points where there
// is none: right for convex objects and a repeatable guess for all others. Where the direction is not defined (points
// on one line), some unit vector perpendicular to it. Coordinates in any unit and of any finite size. Deterministic.
// Throws InputError when there are no points, all are at one place or one is not finite, and when `neighbours` is not
// what PrepareSettings::kNeighbours holds.
std::vector<Vec3> estimate_normals(std::span<const Vec3> points, int neighbours,
                                   const std::optional<Vec3>& towards = std::nullopt);

}  // namespace spincat
#pragma GCC visibility pop
