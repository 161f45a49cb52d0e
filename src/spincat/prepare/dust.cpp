#include "spincat/prepare/dust.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "spincat/prepare/normalise.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/repeats.h"

namespace spincat {
namespace {

constexpr double kMostOfArea = 0.01;
constexpr double kReaches = 2.0;

// Where the triangles lie, seen from the centroid of the surface.
struct Distances {
  std::vector<double> areas;
  std::vector<double> nearest;   // corner of a triangle
  std::vector<double> furthest;  // corner of a triangle
};

Distances distances_of(const Mesh& mesh) {
  Distances distances;
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  const std::vector<Vec3> normals = face_area_normals(mesh);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    distances.areas.push_back(normals[f].norm());
    area += distances.areas[f];
    sum += distances.areas[f] / 3.0 * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
  }
  const Vec3 centroid = area > 0.0 ? Vec3(sum / area) : Vec3(Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const auto [least, most] =
        std::minmax({(mesh.vertices[t[0]] - centroid).norm(), (mesh.vertices[t[1]] - centroid).norm(),
                     (mesh.vertices[t[2]] - centroid).norm()});
    distances.nearest.push_back(least);
    distances.furthest.push_back(most);
  }
  return distances;
}

// The distance that so much of the area does not reach beyond.
double reach_of(const Distances& distances, double area) {
  // A bound without sorting: of the mean distance, what lies beyond the reach adds at most its share of the largest.
  const double largest = std::ranges::max(distances.furthest);
  const double mean =
      std::inner_product(distances.furthest.begin(), distances.furthest.end(), distances.areas.begin(), 0.0) / area;
  const double at_least = (mean - kMostOfArea * largest) / (1.0 - kMostOfArea);
  if (kReaches * at_least > largest) {
    return at_least;  // nothing is beyond, whatever it is exactly
  }
  std::vector<std::uint32_t> order(distances.areas.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t f) { return distances.furthest[f]; });
  double sum = 0.0;
  for (const std::uint32_t f : order) {
    sum += distances.areas[f];
    if (sum >= (1.0 - kMostOfArea) * area) {
      return distances.furthest[f];
    }
  }
  return largest;
}

// For each vertex the smallest of those that it hangs together with.
std::vector<std::uint32_t> pieces_of(const Mesh& mesh) {
  std::vector<std::uint32_t> piece = first_at_position(mesh.vertices);
  const auto root = [&](std::uint32_t v) {
    while (piece[v] != v) {
      v = piece[v] = piece[piece[v]];
    }
    return v;
  };
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : {t[1], t[2]}) {
      const auto [low, high] = std::minmax({root(t[0]), root(v)});  // a list: by value
      piece[high] = low;
    }
  }
  for (std::uint32_t v = 0; v < piece.size(); ++v) {
    piece[v] = root(v);
  }
  return piece;
}

}  // namespace

std::vector<std::uint32_t> dust_of(const Mesh& mesh) {
  if (mesh.triangles.empty()) {
    return {};
  }
  const Distances distances = distances_of(mesh);
  const double area = std::accumulate(distances.areas.begin(), distances.areas.end(), 0.0);
  if (!(area > 0.0)) {
    return {};
  }
  const double limit = kReaches * reach_of(distances, area);
  const auto is_beyond = [&](double nearest) { return nearest > limit; };
  if (std::ranges::none_of(distances.nearest, is_beyond)) {
    return {};
  }
  const std::vector<std::uint32_t> piece = pieces_of(mesh);
  std::vector<bool> belongs(mesh.vertices.size(), false);  // a piece, by its vertex
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!is_beyond(distances.nearest[f])) {
      belongs[piece[mesh.triangles[f][0]]] = true;
    }
  }
  std::vector<std::uint32_t> dust;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!belongs[piece[mesh.triangles[f][0]]]) {
      dust.push_back(f);
    }
  }
  return dust;
}

Mesh without_triangles(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  Mesh rest{mesh.vertices, {}, mesh.left_out};
  auto next = triangles.begin();
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (next != triangles.end() && *next == f) {
      ++next;
    } else {
      rest.triangles.push_back(mesh.triangles[f]);
    }
  }
  return rest;
}

}  // namespace spincat
