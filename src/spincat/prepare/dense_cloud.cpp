#include "spincat/prepare/dense_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/prepare/quantile.h"
#include "spincat/prepare/repeats.h"
#include "spincat/prepare/selected.h"

namespace spincat {
namespace {

constexpr std::size_t kLookedAt = 8'192;                   // points of which the middle and the reach are taken
constexpr double kMost = 0.75;                             // of the points lie within the reach
constexpr double kReaches = 2.0;                           // that the grid extends to each side
constexpr std::array<int, 5> kCells = {64, 32, 16, 8, 4};  // in a reach, the finest first

// Where most of a cloud's points are.
struct Middle {
  Vec3 median = Vec3::Zero();
  double reach = 0.0;
};

Middle middle_of(std::span<const Vec3> points, std::span<const std::uint32_t> chosen) {
  std::vector<Vec3> some;
  const std::size_t step = std::max<std::size_t>(1, chosen.size() / kLookedAt);
  for (std::size_t k = 0; k < chosen.size(); k += step) {
    some.push_back(points[chosen[k]]);
  }
  Middle middle;
  std::vector<double> values(some.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::ranges::transform(some, values.begin(), [&](const Vec3& p) { return p[axis]; });
    middle.median[axis] = quantile(values, 0.5);
  }
  std::ranges::transform(some, values.begin(), [&](const Vec3& p) { return (p - middle.median).stableNorm(); });
  middle.reach = quantile(values, kMost);
  return middle;
}

// The first of the chosen points in each cell, and all that lie outside of the grid.
std::vector<std::uint32_t> first_in_cells(std::span<const Vec3> points, std::span<const std::uint32_t> chosen,
                                          const Middle& middle, int cells) {
  const auto side = static_cast<std::size_t>(2.0 * kReaches * cells);
  const double per_unit = cells / middle.reach;
  const Vec3 corner = middle.median - Vec3::Constant(kReaches * middle.reach);
  std::vector<bool> taken(side * side * side, false);
  std::vector<std::uint32_t> first;
  for (const std::uint32_t i : chosen) {
    const Vec3 at = (points[i] - corner) * per_unit;
    if (!(at.minCoeff() >= 0.0 && at.maxCoeff() < static_cast<double>(side))) {
      first.push_back(i);
      continue;
    }
    const std::size_t cell = (static_cast<std::size_t>(at.x()) * side + static_cast<std::size_t>(at.y())) * side +
                             static_cast<std::size_t>(at.z());
    if (!taken[cell]) {
      taken[cell] = true;
      first.push_back(i);
    }
  }
  return first;
}

}  // namespace

PointCloud without_crowds(const PointCloud& cloud) {
  if (cloud.points.size() <= kDense) {
    return cloud;
  }
  std::vector<std::uint32_t> chosen = measured_points(cloud.points);
  const Middle middle = middle_of(cloud.points, chosen);
  if (middle.reach > 0.0 && std::isfinite(1.0 / middle.reach)) {
    for (std::size_t k = 0; k < kCells.size() && chosen.size() > kDense; ++k) {
      chosen = first_in_cells(cloud.points, chosen, middle, kCells[k]);
    }
  }
  return selected(cloud, chosen);
}

}  // namespace spincat
