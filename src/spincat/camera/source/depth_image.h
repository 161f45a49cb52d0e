// What a depth camera hands over: a picture of distances.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace spincat {

// A pinhole camera: pixel (u, v) with depth z is the point ((u - cx) z / fx, (v - cy) z / fy, z): x to the right, y
// down, z forward. In pixels; the defaults are those of a Kinect's 640 x 480.
struct Intrinsics {
  double fx = 525.0;
  double fy = 525.0;
  double cx = 319.5;
  double cy = 239.5;

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;

  Eigen::Vector3f point(int u, int v, float z) const {
    return {static_cast<float>((u - cx) / fx) * z, static_cast<float>((v - cy) / fy) * z, z};
  }
};

// width x height depths along the optical axis in metres, row by row from the top; 0 where nothing was read. Finite
// (readers see to that; the recogniser takes others for not read).
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> depth;

  DepthImage() = default;
  DepthImage(int columns, int rows)
      : width(columns), height(rows), depth(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0F) {}

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  float at(int u, int v) const { return depth[index(u, v)]; }
};

}  // namespace spincat
