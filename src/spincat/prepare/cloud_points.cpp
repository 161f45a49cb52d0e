#include "spincat/prepare/cloud_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "spincat/prepare/even_out.h"
#include "spincat/prepare/neighbour_distances.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/visible_points.h"

namespace spincat {
namespace {

constexpr std::size_t kMoreThanDrawn = 4;    // times as many points have their normals estimated
constexpr std::size_t kMoreOfRough = 2;      // of a rough surface: more would lie on the same few faces
constexpr std::size_t kFewestVisible = 64;   // fewer say too little: all points are taken, and none put between them
constexpr std::size_t kDiscNeighbours = 8;   // a point's disc reaches so many others
constexpr double kBetween = 0.4;             // of a disc's radius: where points between are put
constexpr int kFewestNeighbours = 12;        // of a thin cloud, for a normal
constexpr std::size_t kNeighbourhoods = 80;  // that a cloud has at least, if its neighbours are not so few

bool has_all_normals(const PointCloud& cloud) {
  const auto known = [](const Vec3& n) { return n.allFinite() && !n.isZero(0.0); };
  return !cloud.normals.empty() && std::ranges::all_of(cloud.normals, known);
}

// A number of a cloud's points, evenly spread, that normals are not estimated for a million points of which two
// thousand are drawn: from neighbours that lie further apart, noise counts for less. Clouds with all normals stay.
PointCloud thinned(PointCloud cloud, std::size_t count, Random& random) {
  if (cloud.points.size() <= count || has_all_normals(cloud)) {
    return cloud;
  }
  cloud.normals.clear();
  const std::vector<Vec3> no_normals(cloud.points.size(), Vec3::Zero());
  cloud.points = even_out({cloud.points, no_normals}, count, random).positions;
  return cloud;
}

std::vector<Vec3> unit_normals(std::vector<Vec3> normals) {
  for (Vec3& n : normals) {
    n.stableNormalize();
  }
  return normals;
}

// Adds points on the discs there are, so that a thin cloud has about `count`: the images of a few points would be
// mostly empty, and so unlike those of a surface.
void fill_up(std::size_t count, Random& random, Discs& discs) {
  auto& [points, radii] = discs;
  const std::size_t given = radii.size();
  for (std::size_t more = 1; more < count / given; ++more) {
    for (std::size_t i = 0; i < given; ++i) {
      const Vec3 normal = points.normals[i];
      const Vec3 across = normal.unitOrthogonal();
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      const double away = kBetween * radii[i] * std::sqrt(random.uniform());
      points.positions.emplace_back(points.positions[i] +
                                    away * (std::cos(angle) * across + std::sin(angle) * normal.cross(across)));
      points.normals.push_back(normal);
      radii.push_back(radii[i]);
    }
  }
}

// What can be seen of a cloud, from the side from which it is seen; nothing where that is too little.
SurfacePoints external_points(const SurfacePoints& points, std::size_t count, Random& random) {
  Discs visible = visible_points({points, neighbour_distances(points.positions, kDiscNeighbours)}, random);
  if (visible.radii.size() < kFewestVisible) {
    return {};
  }
  fill_up(count, random, visible);
  return visible.points;
}

// The neighbours of a thin cloud are few, or they would span half of the object.
int neighbours_of(std::size_t points, const PrepareSettings& settings) {
  const int few = std::max(kFewestNeighbours, static_cast<int>(points / kNeighbourhoods));
  return std::min(settings.neighbours, few);
}

// Of points whose normals are not given.
SurfacePoints with_estimated_normals(const PointCloud& cloud, const PrepareSettings& settings, Random& random) {
  SurfacePoints points{cloud.points, estimated_normals(cloud.points, neighbours_of(cloud.points.size(), settings))};
  if (cloud.sensor) {
    orient_towards(points.positions, *cloud.sensor, points.normals);
    return points;
  }
  if (settings.surface == SurfaceKind::external) {
    SurfacePoints visible = external_points(points, static_cast<std::size_t>(settings.points), random);
    if (!visible.positions.empty()) {
      return visible;
    }
  }
  if (settings.orientation == NormalOrientation::outward) {
    orient_outwards(points.positions, points.normals);
  }
  return points;
}

}  // namespace

SurfacePoints cloud_points(PointCloud cloud, const PrepareSettings& settings, Random& random) {
  const auto count = static_cast<std::size_t>(settings.points);
  const bool takes_all = settings.surface == SurfaceKind::vertices;
  if (!takes_all) {
    cloud = thinned(std::move(cloud), kMoreThanDrawn * count, random);
  }
  const SurfacePoints points = has_all_normals(cloud) ? SurfacePoints{cloud.points, unit_normals(cloud.normals)}
                                                      : with_estimated_normals(cloud, settings, random);
  return takes_all ? points : even_out(points, count, random);
}

SurfacePoints with_normals_of_neighbours(const SurfacePoints& points, const PrepareSettings& settings, Random& random) {
  SurfacePoints some = even_out(points, kMoreOfRough * static_cast<std::size_t>(settings.points), random);
  std::vector<Vec3> normals = estimated_normals(some.positions, settings.neighbours);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    some.normals[i] = normals[i].dot(some.normals[i]) < 0.0 ? Vec3(-normals[i]) : normals[i];
  }
  return some;
}

}  // namespace spincat
