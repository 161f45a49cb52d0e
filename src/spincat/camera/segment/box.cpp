#include "spincat/camera/segment/box.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include "spincat/camera/segment/hull.h"

namespace spincat {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr std::size_t kFewest = 2;  // points in a square for it to count

// The least and the largest along some axes.
struct Extent {
  Eigen::Array2f low = Eigen::Array2f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array2f high = -low;

  void add(const Eigen::Array2f& value) {
    low = low.min(value);
    high = high.max(value);
  }
  float area() const { return (high - low).prod(); }
};

Extent extent_along(const Vector2f& direction, std::span<const Vector2f> places) {
  Extent extent;
  for (const Vector2f& p : places) {
    extent.add({direction.dot(p), direction.x() * p.y() - direction.y() * p.x()});
  }
  return extent;
}

// Where points stand on the plane, by its axes x and y, without those almost alone.
std::vector<std::size_t> crowded(std::span<const Vector2f> places, float cell) {
  std::map<GridPoint, std::size_t> counts;
  const auto cell_of = [&](const Vector2f& p) {
    return GridPoint{static_cast<int>(std::floor(p.x() / cell)), static_cast<int>(std::floor(p.y() / cell))};
  };
  for (const Vector2f& p : places) {
    ++counts[cell_of(p)];
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (counts[cell_of(places[i])] >= kFewest) {
      kept.push_back(i);
    }
  }
  return kept;
}

// The direction of that edge of the hull on which the rectangle around it is smallest: one of its sides lies on an edge
// (Freeman and Shapira 1975).
Vector2f best_direction(std::span<const Vector2f> places) {
  constexpr float kFine = 0.001F;  // metres
  std::vector<GridPoint> points;
  for (const Vector2f& p : places) {
    points.push_back({static_cast<int>(std::lround(p.x() / kFine)), static_cast<int>(std::lround(p.y() / kFine))});
  }
  const std::vector<GridPoint> hull = convex_hull(std::move(points));
  std::vector<Vector2f> corners;
  for (const GridPoint& corner : hull) {
    corners.emplace_back(kFine * static_cast<float>(corner.x), kFine * static_cast<float>(corner.y));
  }
  Vector2f best = Vector2f::UnitX();
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2f edge = corners[(k + 1) % corners.size()] - corners[k];
    if (edge.norm() > 0.0F) {
      const Vector2f direction = edge.normalized();
      if (const float area = extent_along(direction, corners).area(); area < least) {
        least = area;
        best = direction;
      }
    }
  }
  return best;
}

}  // namespace

OrientedBox box_on_plane(std::span<const Vector3f> points, const SupportPlane& plane, float cell, float foot) {
  const Vector3f x_axis = plane.normal.unitOrthogonal();
  const Vector3f y_axis = plane.normal.cross(x_axis);
  std::vector<Vector2f> all;
  for (const Vector3f& p : points) {
    all.emplace_back(x_axis.dot(p), y_axis.dot(p));
  }
  std::vector<Vector2f> places;
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  const std::vector<std::size_t> some = crowded(all, cell);
  for (std::size_t k = 0; k < (some.empty() ? points.size() : some.size()); ++k) {
    const std::size_t i = some.empty() ? k : some[k];
    places.push_back(all[i]);
    low = std::min(low, plane.height(points[i]));
    high = std::max(high, plane.height(points[i]));
  }
  low = low < foot ? 0.0F : low;
  Vector2f direction = best_direction(places);
  Extent extent = extent_along(direction, places);
  if (extent.high[0] - extent.low[0] < extent.high[1] - extent.low[1]) {
    direction = Vector2f(-direction.y(), direction.x());
    extent = extent_along(direction, places);
  }
  OrientedBox box;
  box.axes.col(0) = direction.x() * x_axis + direction.y() * y_axis;
  box.axes.col(1) = plane.normal.cross(Vector3f(box.axes.col(0)));
  box.axes.col(2) = plane.normal;
  const Eigen::Array2f size = extent.high - extent.low;
  box.size = Vector3f(size[0], size[1], high - low);
  const Eigen::Array2f middle = 0.5F * (extent.low + extent.high);
  box.centre = box.axes * Vector3f(middle[0], middle[1], 0.5F * (low + high) - plane.offset);
  return box;
}

}  // namespace spincat
