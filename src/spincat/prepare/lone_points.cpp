#include "spincat/prepare/lone_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "spincat/geometry/point_tree.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/quantile.h"
#include "spincat/prepare/repeats.h"
#include "spincat/prepare/selected.h"

namespace spincat {
namespace {

constexpr std::size_t kNeighbours = 4;
constexpr double kOfUsual = 3.0;           // times the usual spacing, and a point stands alone
constexpr double kOfAround = 4.0;          // times the spacing of its neighbours
constexpr double kOfAroundZero = 1.5;      // where it lies at exactly (0, 0, 0): a sensor's word for nothing
constexpr double kUsual = 0.95;            // of the points have at most the usual spacing
constexpr std::size_t kFewestPoints = 64;  // fewer say nothing about their spacing
constexpr std::size_t kMostOf = 10;        // at most one point in so many stands alone

// Brings most points to a size of about 1, wherever the others are: beside a point at 1e30 all others would be one.
Similarity similarity_of_most(std::span<const Vec3> points) {
  Similarity similarity;
  std::vector<double> values(points.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::ranges::transform(points, values.begin(), [&](const Vec3& p) { return p[axis]; });
    similarity.centre[axis] = quantile(values, 0.5);
  }
  std::ranges::transform(points, values.begin(), [&](const Vec3& p) {
    const Vec3 d = p - similarity.centre;
    return std::hypot(d.x(), d.y(), d.z());
  });
  const double factor = 1.0 / quantile(values, 0.5);
  similarity.factor = std::isfinite(factor) ? factor : 1.0;
  return similarity;
}

// The nearest points of each, itself among them, and how far the last of them is.
struct Spacing {
  std::vector<std::array<std::uint32_t, kNeighbours + 1>> nearest;
  std::vector<double> distance;
};

Spacing spacing_of(std::span<const Vec3> points) {
  const PointsAdaptor adaptor{points};
  const PointTree tree(3, adaptor, {10});
  Spacing spacing;
  spacing.nearest.resize(points.size());
  spacing.distance.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, kNeighbours + 1> squared{};
    tree.knnSearch(points[i].data(), kNeighbours + 1, spacing.nearest[i].data(), squared.data());
    spacing.distance[i] = std::sqrt(squared.back());
  }
  return spacing;
}

// The median, with the point's own: of one neighbour that stands alone itself there is none to be made.
double spacing_around(const Spacing& spacing, std::size_t point) {
  std::array<double, kNeighbours + 1> around{};
  std::ranges::transform(spacing.nearest[point], around.begin(),
                         [&](std::uint32_t neighbour) { return spacing.distance[neighbour]; });
  std::ranges::sort(around);
  return around[kNeighbours / 2];
}

// The first point at each place; none where a sensor measured nothing.
std::vector<std::uint32_t> distinct_points(std::span<const Vec3> points) {
  const std::vector<std::uint32_t> first = first_at_position(points);
  std::vector<std::uint32_t> distinct = measured_points(points);
  std::erase_if(distinct, [&](std::uint32_t i) { return first[i] != i; });
  return distinct;
}

}  // namespace

std::vector<std::uint32_t> lone_points(std::span<const Vec3> points) {
  if (points.size() < kFewestPoints) {
    return {};
  }
  constexpr double kFurthest = 1e100;  // squares stay finite; what is further is moved here, as far from all others
  std::vector<Vec3> moderate(points.size());
  std::ranges::transform(points, moderate.begin(), similarity_of_most(points));
  for (Vec3& p : moderate) {
    p = p.cwiseMax(-kFurthest).cwiseMin(kFurthest);
  }
  const Spacing spacing = spacing_of(moderate);
  const double usual = quantile(spacing.distance, kUsual);
  std::vector<std::uint32_t> lone;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double of_around = points[i].isZero(0.0) ? kOfAroundZero : kOfAround;
    if (spacing.distance[i] > std::min(kOfUsual * usual, of_around * spacing_around(spacing, i))) {
      lone.push_back(i);
    }
  }
  return lone.size() > points.size() / kMostOf ? std::vector<std::uint32_t>() : lone;
}

PointCloud without_lone_points(const PointCloud& cloud) {
  const PointCloud distinct = selected(cloud, distinct_points(cloud.points));
  const std::vector<std::uint32_t> lone = lone_points(distinct.points);
  if (lone.empty()) {
    return distinct;
  }
  std::vector<std::uint32_t> others;
  auto next = lone.begin();
  for (std::uint32_t i = 0; i < distinct.points.size(); ++i) {
    if (next != lone.end() && *next == i) {
      ++next;
    } else {
      others.push_back(i);
    }
  }
  return selected(distinct, others);
}

}  // namespace spincat
