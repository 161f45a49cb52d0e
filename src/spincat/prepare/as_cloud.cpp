#include "spincat/prepare/as_cloud.h"

#include <utility>
#include <variant>
#include <vector>

#include "spincat/geometry/random.h"
#include "spincat/prepare/dust.h"
#include "spincat/prepare/lone_points.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {
namespace {

// Points of the surface as they are, and the diameter of the object.
std::pair<PointCloud, double> points_of(const Object& object, std::size_t points, Random& random) {
  if (const auto* given = std::get_if<PointCloud>(&object)) {
    const PointCloud cloud = without_lone_points(*given);
    return {{cloud.points, {}, cloud.sensor}, 2.0 / unit_similarity(cloud.points).factor};
  }
  const Mesh mesh = without_unused_vertices(std::get<Mesh>(object));
  const Similarity similarity = unit_similarity(mesh.vertices);
  if (const std::vector<std::uint32_t> dust = dust_of(transformed(mesh, similarity)); !dust.empty()) {
    return points_of(without_triangles(mesh, dust), points, random);
  }
  const double diameter = 2.0 / similarity.factor;
  if (!has_area(transformed(mesh, similarity))) {  // at a moderate size: areas of tiny objects vanish
    return {{mesh.vertices, {}, {}}, diameter};
  }
  std::vector<Vec3> drawn = surface_samples(transformed(mesh, similarity), points, random).positions;
  for (Vec3& p : drawn) {
    p = p / similarity.factor + similarity.centre;
  }
  return {{std::move(drawn), {}, {}}, diameter};
}

}  // namespace

PointCloud as_cloud(const Object& object, std::size_t points, double noise, std::uint64_t seed) {
  Random random(seed);
  auto [cloud, diameter] = points_of(object, points, random);
  if (noise > 0.0) {
    for (Vec3& p : cloud.points) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        p[axis] += noise * diameter * random.normal();
      }
    }
  }
  return std::move(cloud);
}

}  // namespace spincat
