#include "spincat/prepare/defects.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "spincat/prepare/mesh_edges.h"
#include "spincat/prepare/normals.h"

namespace spincat {
namespace {

// Two triangles that hang together, and whether they look the same way.
struct Neighbour {
  std::uint32_t triangle = 0;
  bool same_way = false;
};

void find_flat_and_repeated(const Mesh& mesh, const std::vector<Triangle>& corners, MeshDefects& defects) {
  const std::vector<Vec3> normals = face_area_normals(mesh);
  std::vector<std::uint32_t> order;
  std::vector<Triangle> sorted = corners;
  for (std::uint32_t f = 0; f < sorted.size(); ++f) {
    std::ranges::sort(sorted[f]);
    if (normals[f].norm() > 0.0) {
      order.push_back(f);
    } else {
      defects.flat.push_back(f);
    }
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t f) { return sorted[f]; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (sorted[order[i]] == sorted[order[i - 1]]) {
      defects.repeated.push_back(order[i]);
    }
  }
  std::ranges::sort(defects.repeated);
}

// The sides of all triangles that are neither flat nor repeated.
std::vector<Side> sides_of(const std::vector<Triangle>& corners, const MeshDefects& defects) {
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < corners.size(); ++f) {
    if (!std::ranges::binary_search(defects.flat, f) && !std::ranges::binary_search(defects.repeated, f)) {
      add_sides(corners[f], f, sides);
    }
  }
  return sides;
}

std::vector<std::vector<Neighbour>> neighbours_of(std::vector<Side> sides, std::size_t triangles) {
  std::vector<std::vector<Neighbour>> neighbours(triangles);
  for (const auto& [a, b] : shared_edges(std::move(sides))) {
    const bool same_way = a.forward != b.forward;
    neighbours[a.triangle].push_back({b.triangle, same_way});
    neighbours[b.triangle].push_back({a.triangle, same_way});
  }
  return neighbours;
}

// Adds the smaller part of each set of triangles that hang together.
void find_flipped(const std::vector<std::vector<Neighbour>>& neighbours, std::vector<std::uint32_t>& flipped) {
  enum class Way : std::uint8_t { unseen, first, other };
  std::vector<Way> way(neighbours.size(), Way::unseen);
  std::vector<std::uint32_t> set;
  for (std::uint32_t start = 0; start < neighbours.size(); ++start) {
    if (way[start] != Way::unseen) {
      continue;
    }
    set.assign(1, start);
    way[start] = Way::first;
    std::size_t others = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const Way here = way[set[i]];
      for (const Neighbour& next : neighbours[set[i]]) {
        if (way[next.triangle] == Way::unseen) {
          way[next.triangle] = next.same_way ? here : here == Way::first ? Way::other : Way::first;
          others += way[next.triangle] == Way::other ? 1 : 0;
          set.push_back(next.triangle);
        }
      }
    }
    const Way smaller = 2 * others <= set.size() ? Way::other : Way::first;
    std::ranges::copy_if(set, std::back_inserter(flipped), [&](std::uint32_t f) { return way[f] == smaller; });
  }
  std::ranges::sort(flipped);
}

}  // namespace

MeshDefects defects_of(const Mesh& mesh) {
  const std::vector<Triangle> corners = merged_corners(mesh);
  MeshDefects defects;
  find_flat_and_repeated(mesh, corners, defects);
  find_flipped(neighbours_of(sides_of(corners, defects), corners.size()), defects.flipped);
  return defects;
}

}  // namespace spincat
