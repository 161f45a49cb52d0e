#include "spincat/prepare/roughness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "spincat/prepare/mesh_edges.h"
#include "spincat/prepare/normals.h"

namespace spincat {
namespace {

constexpr std::size_t kManyTriangles = 20'000;
constexpr std::uint32_t kScatter = 0x9E3779B9U;  // so that the vertices looked at have no order in a file

// The sides at every step-th vertex.
std::vector<Side> some_sides(const Mesh& mesh, std::size_t step) {
  const std::vector<Triangle> corners = merged_corners(mesh);
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < corners.size(); ++f) {
    add_sides(corners[f], f, sides);
  }
  std::erase_if(sides, [&](const Side& side) { return side.low * kScatter % step != 0; });
  return sides;
}

}  // namespace

double median_fold(const Mesh& mesh) {
  const std::vector<Vec3> normals = face_area_normals(mesh);
  std::vector<double> cosines;
  for (const auto& [a, b] : shared_edges(some_sides(mesh, 1 + mesh.triangles.size() / kManyTriangles))) {
    const Vec3& normal = normals[a.triangle];
    const Vec3& other = normals[b.triangle];
    const double lengths = normal.norm() * other.norm();
    if (lengths > 0.0) {
      cosines.push_back(std::min(std::abs(normal.dot(other)) / lengths, 1.0));
    }
  }
  if (cosines.empty()) {
    return 0.0;
  }
  const auto middle = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 2);
  std::ranges::nth_element(cosines, middle);
  return std::acos(*middle) * 180.0 / std::numbers::pi;
}

}  // namespace spincat
