// Some of a cloud's points.
#pragma once

#include <cstdint>
#include <span>

#include "spincat/geometry/object.h"

namespace spincat {

// The cloud with these of its points alone (indices ascending), with their normals; the others are added to those left
// out. The sensor stays.
PointCloud selected(const PointCloud& cloud, std::span<const std::uint32_t> points);

}  // namespace spincat
