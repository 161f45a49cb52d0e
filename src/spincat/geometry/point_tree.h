// Nearest neighbours among points: nanoflann's k-d tree over a span. Private to prepare.
#pragma once

#include <cstddef>
#include <nanoflann.hpp>
#include <span>

#include "spincat/geometry/object.h"

namespace spincat {

struct PointsAdaptor {
  std::span<const Vec3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // nanoflann then finds it itself
  }
};

using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointsAdaptor>, PointsAdaptor, 3>;

}  // namespace spincat
