#include "spincat/prepare/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "spincat/prepare/normals.h"

namespace spincat {
namespace {

// Uniform in a triangle: the square root evens out the density towards the first corner.
Vec3 point_in_triangle(const Mesh& mesh, const Triangle& t, Random& random) {
  const double r = std::sqrt(random.uniform());
  const double s = random.uniform();
  return (1.0 - r) * mesh.vertices[t[0]] + r * (1.0 - s) * mesh.vertices[t[1]] + r * s * mesh.vertices[t[2]];
}

}  // namespace

SurfacePoints surface_samples(const Mesh& mesh, std::size_t count, Random& random) {
  const std::vector<Vec3> area_normals = face_area_normals(mesh);
  std::vector<double> area_up_to(area_normals.size());
  double total = 0.0;
  for (std::size_t f = 0; f < area_normals.size(); ++f) {
    total += area_normals[f].norm();
    area_up_to[f] = total;
  }
  SurfacePoints samples;
  samples.positions.reserve(count);
  samples.normals.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    // upper_bound never lands on a face without area: its running sum equals that of the face before it.
    const double area = random.uniform() * total;
    const auto at = std::min(std::ranges::upper_bound(area_up_to, area), std::ranges::lower_bound(area_up_to, total));
    const auto f = static_cast<std::size_t>(at - area_up_to.begin());
    samples.positions.push_back(point_in_triangle(mesh, mesh.triangles[f], random));
    samples.normals.emplace_back(area_normals[f].normalized());
  }
  return samples;
}

bool has_area(const Mesh& mesh) {
  return std::ranges::any_of(face_area_normals(mesh), [](const Vec3& n) { return n.squaredNorm() > 0.0; });
}

}  // namespace spincat
