#include "spincat/prepare/mesh_edges.h"

#include <algorithm>
#include <cstddef>

#include "spincat/prepare/repeats.h"

namespace spincat {

std::vector<Triangle> merged_corners(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  std::vector<Triangle> corners = mesh.triangles;
  for (Triangle& t : corners) {
    t = {first[t[0]], first[t[1]], first[t[2]]};
  }
  return corners;
}

void add_sides(const Triangle& corners, std::uint32_t triangle, std::vector<Side>& sides) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = corners[k];
    const std::uint32_t to = corners[(k + 1) % 3];
    sides.push_back({std::min(from, to), std::max(from, to), triangle, from < to});
  }
}

std::vector<std::array<Side, 2>> shared_edges(std::vector<Side> sides) {
  const auto edge_of = [](const Side& side) { return std::array{side.low, side.high}; };
  std::ranges::stable_sort(sides, {}, edge_of);
  std::vector<std::array<Side, 2>> shared;
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin;
    while (end < sides.size() && edge_of(sides[end]) == edge_of(sides[begin])) {
      ++end;
    }
    if (end - begin == 2) {
      shared.push_back({sides[begin], sides[begin + 1]});
    }
    begin = end;
  }
  return shared;
}

}  // namespace spincat
