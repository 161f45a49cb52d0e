#include "spincat/prepare/visible_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "spincat/geometry/rasterise.h"
#include "spincat/prepare/cameras.h"

namespace spincat {
namespace {

constexpr double kFewestViews = 0.25;  // of a point's, for one of its sides to count

// How many cameras see a point from the side of its normal, and from behind.
using Views = std::array<int, 2>;

// The depth at each pixel of what is nearest.
class NearestDepth {
 public:
  NearestDepth() { depth_.fill(std::numeric_limits<double>::infinity()); }

  // A square of that many pixels to each side of a projected point.
  void draw(const Vec3& at, double radius) {
    const double depth = 1.0 / at.z();
    const int last_row = last_pixel(at.y() + radius, Camera::kPixels);
    const int last_column = last_pixel(at.x() + radius, Camera::kPixels);
    for (int row = first_pixel(at.y() - radius, Camera::kPixels); row <= last_row; ++row) {
      for (int column = first_pixel(at.x() - radius, Camera::kPixels); column <= last_column; ++column) {
        double& nearest = depth_[pixel(row, column)];
        nearest = std::min(nearest, depth);
      }
    }
  }

  double at(const Vec3& projected) const {
    return depth_[pixel(std::clamp(static_cast<int>(projected.y()), 0, Camera::kPixels - 1),
                        std::clamp(static_cast<int>(projected.x()), 0, Camera::kPixels - 1))];
  }

 private:
  static std::size_t pixel(int row, int column) {
    return static_cast<std::size_t>(row) * Camera::kPixels + static_cast<std::size_t>(column);
  }

  std::array<double, static_cast<std::size_t>(Camera::kPixels) * Camera::kPixels> depth_;
};

void count_views(const Camera& camera, const Discs& discs, std::vector<Views>& views) {
  const auto& [points, radii] = discs;
  NearestDepth nearest;
  std::vector<Vec3> projected(points.positions.size());
  for (std::size_t i = 0; i < projected.size(); ++i) {
    projected[i] = camera.project(points.positions[i]);
    nearest.draw(projected[i], camera.pixels(radii[i], projected[i].z()));
  }
  for (std::size_t i = 0; i < projected.size(); ++i) {
    if (1.0 / projected[i].z() - radii[i] <= nearest.at(projected[i])) {
      ++views[i][camera.sees_back(points.positions[i], points.normals[i]) ? 1 : 0];
    }
  }
}

}  // namespace

Discs visible_points(const Discs& discs, Random& random) {
  const auto& [points, radii] = discs;
  std::vector<Views> views(radii.size(), Views{});
  for (const Camera& camera : cameras_around(random)) {
    count_views(camera, discs, views);
  }
  Discs visible;
  const auto add = [&](std::size_t i, const Vec3& normal) {
    visible.points.positions.push_back(points.positions[i]);
    visible.points.normals.push_back(normal);
    visible.radii.push_back(radii[i]);
  };
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto [front, back] = views[i];
    const double enough = kFewestViews * (front + back);
    if (front > 0 && front >= enough) {
      add(i, points.normals[i]);
    }
    if (back > 0 && back >= enough) {
      add(i, -points.normals[i]);
    }
  }
  return visible;
}

}  // namespace spincat
