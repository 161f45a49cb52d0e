#include "spincat/prepare/resolution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "spincat/prepare/neighbour_distances.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/repeats.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {
namespace {

double upper_median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The median distance of the distinct points among `given` to their nearest neighbour.
double points_resolution(const std::vector<Vec3>& given) {
  const std::vector<std::uint32_t> first = first_at_position(given);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      points.push_back(given[i]);
    }
  }
  return cloud_resolution(points);
}

}  // namespace

double mesh_resolution(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
    }
  }
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    const double length = (mesh.vertices[a] - mesh.vertices[b]).norm();
    if (length > 0.0) {
      lengths.push_back(length);
    }
  }
  return upper_median(std::move(lengths));
}

double cloud_resolution(std::span<const Vec3> points) {
  if (points.size() < 2) {
    return 0.0;
  }
  return upper_median(neighbour_distances(points, 1));
}

double object_resolution(const Object& object) {
  double resolution = 0.0;
  double factor = 1.0;  // lengths of a moderate size: squares of 1e200 are infinite
  if (const auto* mesh = std::get_if<Mesh>(&object)) {
    const Similarity similarity = unit_similarity(mesh->vertices);
    const Mesh moderate = transformed(*mesh, similarity);
    factor = similarity.factor;
    resolution = has_area(moderate) ? mesh_resolution(moderate) : points_resolution(moderate.vertices);
  } else {
    const auto& cloud = std::get<PointCloud>(object);
    const Similarity similarity = unit_similarity(cloud.points);
    factor = similarity.factor;
    resolution = points_resolution(transformed(cloud, similarity).points);
  }
  return resolution / factor;
}

}  // namespace spincat
