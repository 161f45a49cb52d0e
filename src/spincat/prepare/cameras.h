// The cameras that look at a normalised object from all around, to tell what can be seen from outside.
#pragma once

#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"

namespace spincat {

// A camera at `eye` that looks at the origin. Its frame: x right, y down the image, z forward.
class Camera {
 public:
  static constexpr int kPixels = 64;            // rows and columns of its picture
  static constexpr double kFieldOfView = 42.0;  // degrees; from distance 3 the unit sphere spans 38.9 degrees

  explicit Camera(const Vec3& eye);

  // Pixel coordinates (pixel (c, r) has its centre at (c + .5, r + .5)), and one over the depth, which is linear over
  // the image of a plane.
  Vec3 project(const Vec3& p) const {
    const Vec3 q = axes_ * (p - eye_);
    const double inverse_depth = 1.0 / q.z();
    return {0.5 * kPixels + kFocal * q.x() * inverse_depth, 0.5 * kPixels + kFocal * q.y() * inverse_depth,
            inverse_depth};
  }

  // How many pixels a length spans at that depth.
  double pixels(double length, double inverse_depth) const { return kFocal * length * inverse_depth; }

  Vec3 unproject(int column, int row, double inverse_depth) const {
    const double depth = 1.0 / inverse_depth;
    const Vec3 q((column + 0.5 - 0.5 * kPixels) / kFocal * depth, (row + 0.5 - 0.5 * kPixels) / kFocal * depth, depth);
    return eye_ + axes_.transpose() * q;
  }

  // Whether a surface at `p` with that normal shows its back.
  bool sees_back(const Vec3& p, const Vec3& normal) const { return (eye_ - p).dot(normal) < 0.0; }

 private:
  static const double kFocal;
  Vec3 eye_;
  Eigen::Matrix3d axes_;
};

// At the 20 corners of a dodecahedron of radius 3 that `random` turns at random. Deterministic for one state of
// `random`.
std::vector<Camera> cameras_around(Random& random);

}  // namespace spincat
