// Which positions are the same.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// For each point the index of the first point at exactly its position (its own index where it is that first one).
std::vector<std::uint32_t> first_at_position(std::span<const Vec3> points);

// Indices of the points that were measured, ascending: all of them, but where several lie at exactly (0, 0, 0), which
// is a sensor's word for nothing, those; unless they are all there is.
std::vector<std::uint32_t> measured_points(std::span<const Vec3> points);

// Whether there is only one position.
bool all_at_one_place(std::span<const Vec3> points);

}  // namespace spincat
