#include "spincat/camera/segment/box.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "spincat/camera/segment/hull.h"

namespace spincat {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr std::uint32_t kFewest = 2;  // points in a square for it to count

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

// Places on the plane, in squares.
class Squares {
 public:
  Squares(std::span<const Vector2f> places, float cell) : places_(places), cell_(cell) {
    for (const Vector2f& p : places) {
      extent_.add(p);
    }
    constexpr float kMost = 2'000.0F;  // squares along an axis
    cell_ = std::max(cell, (extent_.high - extent_.low).maxCoeff() / kMost);
    columns_ = cell_of(extent_.high.matrix()).x + 1;
    rows_ = cell_of(extent_.high.matrix()).y + 1;
    counts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (const Vector2f& p : places) {
      ++counts_[index_of(cell_of(p))];
    }
  }

  // The places that are not almost alone in their squares; all where each is.
  std::vector<std::uint32_t> crowded() const {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      if (counts_[index_of(cell_of(places_[i]))] >= kFewest) {
        kept.push_back(i);
      }
    }
    if (kept.empty()) {
      kept.resize(places_.size());
      std::iota(kept.begin(), kept.end(), 0U);
    }
    return kept;
  }

  // Of these places the outermost of each row and column of squares: their hull is that of all but for a square.
  std::vector<Vector2f> outermost(std::span<const std::uint32_t> some) const {
    std::vector<Extreme> by_row(static_cast<std::size_t>(rows_));
    std::vector<Extreme> by_column(static_cast<std::size_t>(columns_));
    for (const std::uint32_t i : some) {
      const GridPoint cell = cell_of(places_[i]);
      by_row[static_cast<std::size_t>(cell.y)].add(places_[i].x(), i);
      by_column[static_cast<std::size_t>(cell.x)].add(places_[i].y(), i);
    }
    std::vector<Vector2f> result;
    for (const std::vector<Extreme>* all : {&by_row, &by_column}) {
      for (const Extreme& extreme : *all) {
        if (extreme.least <= extreme.most) {
          result.push_back(places_[extreme.at_least]);
          result.push_back(places_[extreme.at_most]);
        }
      }
    }
    return result;
  }

 private:
  struct Extreme {
    float least = std::numeric_limits<float>::infinity();
    float most = -least;
    std::uint32_t at_least = 0;
    std::uint32_t at_most = 0;

    void add(float value, std::uint32_t i) {
      at_least = value < least ? i : at_least;
      at_most = value > most ? i : at_most;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  };

  GridPoint cell_of(const Vector2f& p) const {
    return {static_cast<int>((p.x() - extent_.low[0]) / cell_), static_cast<int>((p.y() - extent_.low[1]) / cell_)};
  }
  std::size_t index_of(const GridPoint& cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(cell.x);
  }

  std::span<const Vector2f> places_;
  Extent extent_;
  float cell_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> counts_;
};

// The direction of that edge of the hull on which the rectangle around it is smallest: one of its sides lies on an edge
// (Freeman and Shapira 1975).
Vector2f best_direction(std::span<const Vector2f> places) {
  constexpr float kFine = 0.001F;  // metres
  std::vector<GridPoint> points;
  for (const Vector2f& p : places) {
    points.push_back({static_cast<int>(std::lround(p.x() / kFine)), static_cast<int>(std::lround(p.y() / kFine))});
  }
  std::vector<Vector2f> corners;
  for (const GridPoint& corner : convex_hull(std::move(points))) {
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
  const Squares squares(all, cell);
  const std::vector<std::uint32_t> some = squares.crowded();
  const std::vector<Vector2f> places = squares.outermost(some);
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (const std::uint32_t i : some) {
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
