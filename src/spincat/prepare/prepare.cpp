#include "spincat/prepare/prepare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "spincat/geometry/left_out.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/cloud_points.h"
#include "spincat/prepare/dense_cloud.h"
#include "spincat/prepare/dust.h"
#include "spincat/prepare/even_out.h"
#include "spincat/prepare/external_surface.h"
#include "spincat/prepare/lone_points.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/repeats.h"
#include "spincat/prepare/roughness.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {
namespace {

// What the random numbers of one object are for (derive_seed's purpose).
enum Purpose : std::uint64_t { kSurface = 1, kStretch = 2 };

// Fewer points than this from outside (objects thinner than a pixel) say too little: all faces are sampled instead.
constexpr std::size_t kFewestExternalPoints = 64;

// A mesh with so many faces whose neighbours are so far from being in one plane is rough: a scan, not a shape that
// somebody drew.
constexpr std::size_t kFewestOfRough = 1000;
constexpr double kRoughFold = 20.0;  // degrees

// The surface found for an object, in a frame of moderate size, before the spin points are chosen.
struct Surface {
  SurfacePoints points;
  Similarity frame;                 // from the file to that frame
  std::vector<std::uint32_t> rows;  // which of the file's points SurfaceKind::vertices has taken
};

bool is_rough(const Mesh& mesh) {
  return mesh.triangles.size() >= kFewestOfRough && median_fold(mesh) > kRoughFold;
}

// `mesh` is normalised and has area.
SurfacePoints mesh_points(const Mesh& mesh, const PrepareSettings& settings, Random& random) {
  const auto count = static_cast<std::size_t>(settings.points);
  if (settings.surface == SurfaceKind::external) {
    const SurfacePoints seen = external_surface(mesh, random);
    if (seen.positions.size() >= kFewestExternalPoints) {
      return even_out(is_rough(mesh) ? with_normals_of_neighbours(seen, settings, random) : seen, count, random);
    }
  }
  SurfacePoints points = settings.surface == SurfaceKind::vertices ? SurfacePoints{mesh.vertices, vertex_normals(mesh)}
                                                                   : surface_samples(mesh, count, random);
  if (settings.orientation == NormalOrientation::outward) {
    orient_outwards(points.positions, points.normals);
  }
  return points;
}

Surface cloud_surface(const PointCloud& given, const PrepareSettings& settings, Random& random) {
  const bool is_thinned = settings.surface != SurfaceKind::vertices && given.points.size() > kDense;
  const PointCloud object = is_thinned ? without_lone_points(without_crowds(given)) : without_lone_points(given);
  const Similarity similarity = unit_similarity(object.points);
  return {cloud_points(transformed(object, similarity), settings, random), similarity,
          rows_of_kept(object.points.size(), object.left_out)};
}

Surface mesh_surface(const Mesh& given, const PrepareSettings& settings, Random& random) {
  Mesh mesh = without_unused_vertices(given);
  if (all_at_one_place(mesh.vertices)) {
    return cloud_surface({given.vertices, {}, {}, given.left_out}, settings, random);
  }
  const Similarity similarity = unit_similarity(mesh.vertices);
  mesh = transformed(mesh, similarity);
  if (const std::vector<std::uint32_t> dust = dust_of(mesh); !dust.empty()) {
    return mesh_surface(without_triangles(given, dust), settings, random);
  }
  if (!has_area(mesh)) {
    return cloud_surface({given.vertices, {}, {}, given.left_out}, settings, random);
  }
  return {mesh_points(mesh, settings, random), similarity, rows_of_kept(mesh.vertices.size(), mesh.left_out)};
}

Surface find_surface(const Object& object, const PrepareSettings& settings, Random& random) {
  if (const auto* mesh = std::get_if<Mesh>(&object)) {
    return mesh_surface(*mesh, settings, random);
  }
  return cloud_surface(std::get<PointCloud>(object), settings, random);
}

OrientedPoints oriented(const SurfacePoints& points, const Similarity& similarity) {
  OrientedPoints result(points.positions.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result.set(i, similarity(points.positions[i]).cast<float>(), points.normals[i].cast<float>());
  }
  return result;
}

// Which of so many surface points are the spin points.
std::vector<std::uint32_t> choose_spin_points(std::size_t points, const PrepareSettings& settings, Random& random) {
  const auto count = static_cast<std::size_t>(settings.spin_points);
  std::vector<std::uint32_t> order(points);
  std::iota(order.begin(), order.end(), 0U);
  if (settings.surface != SurfaceKind::vertices) {
    order.resize(std::min(count, points));  // the draw is in random order already
    return order;
  }
  for (std::size_t i = points; i > 1; --i) {
    std::swap(order[i - 1], order[random.below(i)]);
  }
  order.resize(count);
  for (std::size_t k = points; k < count; ++k) {
    order[k] = order[k % points];
  }
  return order;
}

}  // namespace

PreparedObject prepare(const Object& object, const PrepareSettings& settings, std::uint64_t seed) {
  settings.validate();
  Random random(derive_seed(seed, kSurface));
  const Surface surface = find_surface(object, settings, random);
  // Once more on the points themselves: what was not seen must not decide about size and place.
  const Similarity similarity = unit_similarity(surface.points.positions);
  PreparedObject prepared;
  prepared.surface = oriented(surface.points, similarity);
  const std::vector<std::uint32_t> chosen = choose_spin_points(prepared.surface.size(), settings, random);
  prepared.spin_points = OrientedPoints(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    prepared.spin_points.set(k, prepared.surface.position(chosen[k]), prepared.surface.normal(chosen[k]));
  }
  if (settings.surface == SurfaceKind::vertices) {
    for (const std::uint32_t i : chosen) {
      prepared.spin_rows.push_back(surface.rows[i]);
    }
    prepared.surface_rows = surface.rows;
  }
  prepared.scale = surface.frame.factor * similarity.factor;
  prepared.centre = surface.frame.centre + similarity.centre / surface.frame.factor;
  return prepared;
}

Object stretched_copy(const Object& object, int copy, double amount, std::uint64_t seed) {
  Random random(derive_seed(derive_seed(seed, kStretch), static_cast<std::uint64_t>(copy)));
  Vec3 factors;
  for (int axis = 0; axis < 3; ++axis) {
    factors[axis] = std::exp(random.uniform(-amount, amount));
  }
  return std::visit([&](const auto& it) { return Object(stretched(it, factors)); }, object);
}

}  // namespace spincat
