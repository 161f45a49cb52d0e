// Where a pixel's ray goes over a plane.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "spincat/camera/segment/scene.h"
#include "spincat/camera/source/frame_source.h"

namespace spincat {

// The ray of each pixel, taken so long that its depth is 1, along three directions: the plane's normal and two axes of
// the plane. Each is a sum of what depends on the column and what depends on the row.
class PlaneRays {
 public:
  PlaneRays(int width, int height, const Intrinsics& intrinsics, const SupportPlane& plane,
            const Eigen::Vector3f& x_axis, const Eigen::Vector3f& y_axis)
      : offset_(plane.offset) {
    Eigen::Matrix3f directions;
    directions << x_axis, y_axis, plane.normal;
    for (int u = 0; u < width; ++u) {
      across_.push_back(directions.row(0).transpose() * static_cast<float>((u - intrinsics.cx) / intrinsics.fx));
    }
    for (int v = 0; v < height; ++v) {
      down_.push_back(directions.row(1).transpose() * static_cast<float>((v - intrinsics.cy) / intrinsics.fy) +
                      directions.row(2).transpose());
    }
  }

  // Along the axes and the normal, at depth 1.
  Eigen::Array3f at(int u, int v) const {
    return across_[static_cast<std::size_t>(u)] + down_[static_cast<std::size_t>(v)];
  }

  // The height over the plane of a reading at depth z.
  float height(int u, int v, float z) const { return z * at(u, v)[2] + offset_; }

 private:
  float offset_;
  std::vector<Eigen::Array3f> across_;
  std::vector<Eigen::Array3f> down_;
};

}  // namespace spincat
