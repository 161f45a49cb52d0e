#include "sight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace {

constexpr double kElevation = 22.0;     // degrees above the horizon
constexpr double kDotRadius = 3.5;      // pixels that a point covers, for hiding others
constexpr double kHidingDistance = 12;  // pixels that it must be nearer

Eigen::Matrix3f view_rotation(double azimuth) {
  const auto radians = [](double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180.0); };
  return (Eigen::AngleAxisf(radians(kElevation), Eigen::Vector3f::UnitX()) *
          Eigen::AngleAxisf(radians(-azimuth), Eigen::Vector3f::UnitY()))
      .toRotationMatrix();
}

SeenPoint seen(const Eigen::Vector3f& position, Eigen::Vector3f normal) {
  // What is seen is turned to the viewer, whichever side the normal was chosen for.
  if (normal.z() < 0.0F) {
    normal = -normal;
  }
  const Eigen::Vector3f light = Eigen::Vector3f(-0.45F, 0.8F, 0.4F).normalized();
  return {position.x(), -position.y(), position.z(), 0.5 + 0.5 * normal.dot(light), false};
}

// Scales and moves the picture so that the first `count` points fill the box; returns the scale.
double fit(std::vector<SeenPoint>& points, std::size_t count, const Box& box) {
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(count);
  const auto [left, right] = std::minmax_element(points.begin(), end, [](auto& a, auto& b) { return a.x < b.x; });
  const auto [top, bottom] = std::minmax_element(points.begin(), end, [](auto& a, auto& b) { return a.y < b.y; });
  const double centre_x = (left->x + right->x) / 2.0;
  const double centre_y = (top->y + bottom->y) / 2.0;
  const double scale = std::min(box.width / (right->x - left->x), box.height / (bottom->y - top->y));
  for (SeenPoint& point : points) {
    point.x = box.x + box.width / 2.0 + (point.x - centre_x) * scale;
    point.y = box.y + box.height / 2.0 + (point.y - centre_y) * scale;
    point.depth *= scale;
  }
  return scale;
}

// Every one of the first `count` points is a small disc that hides what lies behind it.
void hide(std::vector<SeenPoint>& points, std::size_t count) {
  for (SeenPoint& point : points) {
    point.hidden = std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count), [&](auto& other) {
      return other.depth > point.depth + kHidingDistance &&
             std::hypot(other.x - point.x, other.y - point.y) < kDotRadius;
    });
  }
}

}  // namespace

Sight look_at(const spincat::OrientedPoints& surface, const spincat::OrientedPoints& marks, double azimuth,
              const Box& box) {
  const Eigen::Matrix3f rotation = view_rotation(azimuth);
  Sight sight;
  for (const spincat::OrientedPoints* each : {&surface, &marks}) {
    for (std::size_t i = 0; i < each->size(); ++i) {
      sight.points.push_back(seen(rotation * each->position(i), rotation * each->normal(i)));
    }
  }
  sight.scale = fit(sight.points, surface.size(), box);
  hide(sight.points, surface.size());
  return sight;
}

std::vector<std::size_t> far_apart(const std::vector<SeenPoint>& points, std::size_t first, std::size_t count) {
  std::vector<std::size_t> chosen;
  // Begins at the top: the tip of a back, the far edge of a table.
  std::vector<double> distance(points.size(), std::numeric_limits<double>::max());
  const auto better = [&](std::size_t a, std::size_t b) {
    return std::tuple(distance[a], -points[a].y) > std::tuple(distance[b], -points[b].y);
  };
  while (chosen.size() < count) {
    std::size_t best = points.size();
    for (std::size_t i = first; i < points.size(); ++i) {
      if (!points[i].hidden && distance[i] > 0.0 && (best == points.size() || better(i, best))) {
        best = i;
      }
    }
    if (best == points.size()) {
      break;
    }
    chosen.push_back(best - first);
    for (std::size_t i = first; i < points.size(); ++i) {
      distance[i] = std::min(distance[i], std::hypot(points[i].x - points[best].x, points[i].y - points[best].y));
    }
  }
  return chosen;
}
