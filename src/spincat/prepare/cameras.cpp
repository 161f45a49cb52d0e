#include "spincat/prepare/cameras.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace spincat {
namespace {

constexpr double kEyeDistance = 3.0;  // from the origin

// A rotation drawn uniformly from all rotations (Shoemake's unit quaternion from three uniform numbers).
Eigen::Matrix3d random_rotation(Random& random) {
  const double u = random.uniform();
  const double v = 2.0 * std::numbers::pi * random.uniform();
  const double w = 2.0 * std::numbers::pi * random.uniform();
  const double a = std::sqrt(1.0 - u);
  const double b = std::sqrt(u);
  return Eigen::Quaterniond(a * std::sin(v), a * std::cos(v), b * std::sin(w), b * std::cos(w)).toRotationMatrix();
}

std::array<Vec3, 20> dodecahedron_corners() {
  constexpr double kPhi = std::numbers::phi;
  std::array<Vec3, 20> corners;
  std::size_t n = 0;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) {
        corners[n++] = Vec3(a, b, c);
      }
      corners[n++] = Vec3(0.0, a / kPhi, b * kPhi);
      corners[n++] = Vec3(a / kPhi, b * kPhi, 0.0);
      corners[n++] = Vec3(b * kPhi, 0.0, a / kPhi);
    }
  }
  for (Vec3& corner : corners) {
    corner.normalize();
  }
  return corners;
}

}  // namespace

const double Camera::kFocal = 0.5 * kPixels / std::tan(0.5 * kFieldOfView * std::numbers::pi / 180.0);

Camera::Camera(const Vec3& eye) : eye_(eye) {
  const Vec3 forward = -eye.normalized();
  const Vec3 helper = std::abs(forward.z()) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 right = forward.cross(helper).normalized();
  axes_.row(0) = right;
  axes_.row(1) = forward.cross(right);
  axes_.row(2) = forward;
}

std::vector<Camera> cameras_around(Random& random) {
  const Eigen::Matrix3d turn = random_rotation(random);
  std::vector<Camera> cameras;
  for (const Vec3& corner : dodecahedron_corners()) {
    cameras.emplace_back(kEyeDistance * (turn * corner));
  }
  return cameras;
}

}  // namespace spincat
