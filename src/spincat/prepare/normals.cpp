#include "spincat/prepare/normals.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "spincat/geometry/point_tree.h"
#include "spincat/prepare/repeats.h"

namespace spincat {
namespace {

// `v` with length 1, or (0, 0, 1) where it has no direction.
Vec3 unit_or_up(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3(0.0, 0.0, 1.0);
}

Vec3 direction_of_least_spread(std::span<const Vec3> points, std::span<const std::uint32_t> neighbours) {
  Vec3 mean = Vec3::Zero();
  for (const std::uint32_t i : neighbours) {
    mean += points[i];
  }
  mean /= static_cast<double>(neighbours.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : neighbours) {
    const Vec3 d = points[i] - mean;
    spread += d * d.transpose();
  }
  // The iterative solver, not computeDirect: the closed form loses the small eigenvalue of thin neighbourhoods.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  return unit_or_up(solver.eigenvectors().col(0));
}

}  // namespace

std::vector<Vec3> face_area_normals(const Mesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 ab = mesh.vertices[t[1]] - a;
    const Vec3 ac = mesh.vertices[t[2]] - a;
    normals.emplace_back(0.5 * ab.cross(ac));
  }
  return normals;
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  const std::vector<Vec3> faces = face_area_normals(mesh);
  std::vector<Vec3> sums(mesh.vertices.size(), Vec3::Zero());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      sums[first[v]] += faces[f];
    }
  }
  std::vector<Vec3> normals(mesh.vertices.size());
  std::ranges::transform(first, normals.begin(), [&](std::uint32_t v) { return unit_or_up(sums[v]); });
  return normals;
}

std::vector<Vec3> estimated_normals(std::span<const Vec3> points, int neighbours) {
  const PointsAdaptor adaptor{points};
  const PointTree tree(3, adaptor, {10});
  const std::size_t wanted = std::min<std::size_t>(neighbours, points.size());
  std::vector<std::uint32_t> found(wanted);
  std::vector<double> squared_distances(wanted);
  std::vector<Vec3> normals;
  normals.reserve(points.size());
  for (const Vec3& p : points) {
    const std::size_t n = tree.knnSearch(p.data(), wanted, found.data(), squared_distances.data());
    normals.push_back(direction_of_least_spread(points, {found.data(), n}));
  }
  return normals;
}

void orient_towards(std::span<const Vec3> points, const Vec3& sensor, std::span<Vec3> normals) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((sensor - points[i]).dot(normals[i]) < 0.0) {
      normals[i] = -normals[i];
    }
  }
}

void orient_outwards(std::span<const Vec3> points, std::span<Vec3> normals) {
  const Vec3 sum = std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero()));
  const Vec3 centroid = sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i] - centroid).dot(normals[i]) < 0.0) {
      normals[i] = -normals[i];
    }
  }
}

}  // namespace spincat
