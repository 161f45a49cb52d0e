#include "spincat/evaluate/enclosed_space.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "spincat/geometry/rasterise.h"

namespace spincat {
namespace {

constexpr int kPixels = 64;  // rows and columns, from -1 to 1

// One of each two opposite directions.
std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  for (int k = 14; k < 27; ++k) {  // 13 is the middle of a cube of 3 x 3 x 3
    all.push_back(Vec3(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1).normalized());
  }
  return all;
}

Eigen::Matrix3d axes_along(const Vec3& along) {
  const Vec3 right = along.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes.row(0) = right;
  axes.row(1) = along.cross(right);
  axes.row(2) = along;
  return axes;
}

// Pixel coordinates, and how far along the line.
Vec3 projected(const Eigen::Matrix3d& axes, const Vec3& p) {
  const Vec3 q = axes * p;
  return {0.5 * kPixels * (q.x() + 1.0), 0.5 * kPixels * (q.y() + 1.0), q.z()};
}

}  // namespace

EnclosedSpace::EnclosedSpace(const Mesh& mesh) {
  constexpr std::size_t kSize = std::size_t{kPixels} * kPixels;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  for (const Vec3& along : directions()) {
    Picture picture{axes_along(along), std::vector<double>(kSize, kFar), std::vector<double>(kSize, -kFar)};
    std::vector<Vec3> corners(mesh.vertices.size());
    std::ranges::transform(mesh.vertices, corners.begin(), [&](const Vec3& v) { return projected(picture.axes, v); });
    for (const Triangle& t : mesh.triangles) {
      draw_triangle(kPixels, kPixels, corners[t[0]], corners[t[1]], corners[t[2]], [&](std::size_t pixel, double at) {
        picture.first[pixel] = std::min(picture.first[pixel], at);
        picture.last[pixel] = std::max(picture.last[pixel], at);
      });
    }
    pictures_.push_back(std::move(picture));
  }
}

bool EnclosedSpace::contains(const Vec3& p) const {
  return std::ranges::all_of(pictures_, [&](const Picture& picture) {
    const Vec3 at = projected(picture.axes, p);
    if (!(std::min(at.x(), at.y()) >= 0.0 && std::max(at.x(), at.y()) < kPixels)) {
      return false;
    }
    const auto pixel = static_cast<std::size_t>(at.y()) * kPixels + static_cast<std::size_t>(at.x());
    return picture.first[pixel] < at.z() && at.z() < picture.last[pixel];
  });
}

bool EnclosedSpace::contains(const Vec3& low, const Vec3& high) const {
  const Eigen::AlignedBox3d box(low, high);
  if (!contains(Vec3(box.center()))) {
    return false;
  }
  for (int k = 0; k < 8; ++k) {
    if (!contains(Vec3(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k))))) {
      return false;
    }
  }
  return true;
}

}  // namespace spincat
