// The middle of points.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "spincat/geometry/oriented_points.h"

namespace spincat {

// The mean of their positions; 0 where there is none.
inline Eigen::Vector3d mean_position(const OrientedPoints& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points.position(i).cast<double>();
  }
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

}  // namespace spincat
