#include "spincat/prepare/normalise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/left_out.h"

namespace spincat {
namespace {

// The largest distance from the centre. By hypot, which neither overflows nor loses small numbers but is slow: squares
// tell which points are worth it, where they can be trusted themselves.
double longest_of(std::span<const Vec3> points, const Vec3& centre) {
  double square = 0.0;
  for (const Vec3& p : points) {
    square = std::max(square, (p - centre).squaredNorm());
  }
  constexpr double kSmallest = 1e-280;
  constexpr double kLargest = 1e280;
  constexpr double kRounding = 1e-12;
  const double enough = square > kSmallest && square < kLargest ? square * (1.0 - kRounding) : 0.0;
  double longest = 0.0;
  for (const Vec3& p : points) {
    const Vec3 d = p - centre;
    if (!(d.squaredNorm() < enough)) {
      longest = std::max(longest, std::hypot(d.x(), d.y(), d.z()));
    }
  }
  return longest;
}

}  // namespace

Similarity unit_similarity(std::span<const Vec3> points) {
  if (points.empty()) {
    throw InputError("holds no points");
  }
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Halves before the sum, and the length by hypot: neither overflows for finite coordinates.
  const Vec3 centre = 0.5 * low + 0.5 * high;
  const double furthest = longest_of(points, centre);
  const double factor = 1.0 / furthest;
  if (!(furthest > 0.0) || !std::isfinite(factor) || !std::isfinite(furthest)) {
    throw InputError("all its points are at one place");
  }
  return {centre, factor};
}

Mesh without_unused_vertices(const Mesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      place[v] = 0;
    }
  }
  const std::vector<std::uint32_t> rows = rows_of_kept(place.size(), mesh.left_out);
  Mesh result;
  result.left_out = mesh.left_out;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] != kUnused) {
      place[v] = static_cast<std::uint32_t>(result.vertices.size());
      result.vertices.push_back(mesh.vertices[v]);
    } else {
      result.left_out.push_back(rows[v]);
    }
  }
  std::ranges::sort(result.left_out);
  result.triangles = mesh.triangles;
  for (Triangle& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) {
      v = place[v];
    }
  }
  return result;
}

Mesh transformed(const Mesh& mesh, const Similarity& similarity) {
  Mesh result = mesh;
  std::ranges::transform(mesh.vertices, result.vertices.begin(), similarity);
  return result;
}

PointCloud transformed(const PointCloud& cloud, const Similarity& similarity) {
  PointCloud result = cloud;
  std::ranges::transform(cloud.points, result.points.begin(), similarity);
  if (result.sensor) {
    result.sensor = similarity(*result.sensor);
  }
  return result;
}

Mesh stretched(const Mesh& mesh, const Vec3& factors) {
  Mesh result = mesh;
  for (Vec3& v : result.vertices) {
    v = v.cwiseProduct(factors);
  }
  return result;
}

PointCloud stretched(const PointCloud& cloud, const Vec3& factors) {
  PointCloud result = cloud;
  for (Vec3& p : result.points) {
    p = p.cwiseProduct(factors);
  }
  for (Vec3& n : result.normals) {
    n = n.cwiseQuotient(factors);
  }
  if (result.sensor) {
    result.sensor = result.sensor->cwiseProduct(factors);
  }
  return result;
}

}  // namespace spincat
