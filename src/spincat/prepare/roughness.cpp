#include "spincat/prepare/roughness.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "spincat/prepare/normals.h"
#include "spincat/prepare/repeats.h"

namespace spincat {
namespace {

constexpr std::size_t kManyTriangles = 20'000;
constexpr std::uint32_t kScatter = 0x9E3779B9U;  // so that the vertices looked at have no order in a file

struct Side {
  std::uint32_t low;  // the smaller end of the edge
  std::uint32_t high;
  std::uint32_t triangle;
  auto operator<=>(const Side&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

// The sides of all triangles, edge by edge; those at every step-th vertex alone.
std::vector<Side> sorted_sides(const Mesh& mesh, std::size_t step) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = first[mesh.triangles[f][k]];
      const std::uint32_t to = first[mesh.triangles[f][(k + 1) % 3]];
      if (std::min(from, to) * kScatter % step == 0) {
        sides.push_back({std::min(from, to), std::max(from, to), f});
      }
    }
  }
  std::ranges::sort(sides);
  return sides;
}

}  // namespace

double median_fold(const Mesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh, 1 + mesh.triangles.size() / kManyTriangles);
  const std::vector<Vec3> normals = face_area_normals(mesh);
  std::vector<double> cosines;
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(), [&](const Side& side) { return !side.same_edge(*begin); });
    if (end - begin == 2) {
      const Vec3& a = normals[begin->triangle];
      const Vec3& b = normals[(begin + 1)->triangle];
      const double lengths = a.norm() * b.norm();
      if (lengths > 0.0) {
        cosines.push_back(std::min(std::abs(a.dot(b)) / lengths, 1.0));
      }
    }
    begin = end;
  }
  if (cosines.empty()) {
    return 0.0;
  }
  const auto middle = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 2);
  std::ranges::nth_element(cosines, middle);
  return std::acos(*middle) * 180.0 / std::numbers::pi;
}

}  // namespace spincat
