#include "spincat/report/shape_json.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <limits>

namespace spincat {
namespace {

// In base64: a triangle has three indices and, as a rule, half a vertex of its own.
constexpr std::size_t kTriangleBytes = 12;
constexpr std::size_t kPointBytes = 8;

Vec3 placed(const Vec3& in_file, const PreparedObject& frame) {
  return (in_file - frame.centre) * frame.scale;
}

constexpr double kFarthest = 2.0;

void add_place(const Vec3& place, std::vector<std::int16_t>& numbers) {
  for (int axis = 0; axis < 3; ++axis) {
    numbers.push_back(short_number(place[axis] / kFarthest));
  }
}

struct PageMesh {
  std::vector<float> positions;  // 3 n
  std::vector<unsigned> indices;
};

// Vertices at one place are one vertex, so that simplifying keeps the surface together.
PageMesh page_mesh(const Mesh& mesh, const PreparedObject& frame) {
  std::vector<std::array<float, 3>> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      const Vec3 p = placed(mesh.vertices[v], frame);
      corners.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
  }
  PageMesh result;
  result.indices.resize(corners.size());
  const std::size_t count = meshopt_generateVertexRemap(result.indices.data(), nullptr, corners.size(), corners.data(),
                                                        corners.size(), sizeof(corners[0]));
  result.positions.resize(3 * count);
  meshopt_remapVertexBuffer(result.positions.data(), corners.data(), corners.size(), sizeof(corners[0]),
                            result.indices.data());
  return result;
}

void simplify(PageMesh& mesh, std::size_t most_triangles) {
  std::vector<unsigned> fewer(mesh.indices.size());
  const std::size_t wanted = 3 * most_triangles;
  const std::size_t vertices = mesh.positions.size() / 3;
  constexpr float kAnyError = 1.0F;
  std::size_t kept = meshopt_simplify(fewer.data(), mesh.indices.data(), mesh.indices.size(), mesh.positions.data(),
                                      vertices, 3 * sizeof(float), wanted, kAnyError, 0, nullptr);
  if (kept > wanted + wanted / 4) {  // its rules for borders left too much: the sloppy way knows none
    kept = meshopt_simplifySloppy(fewer.data(), mesh.indices.data(), mesh.indices.size(), mesh.positions.data(),
                                  vertices, 3 * sizeof(float), wanted, kAnyError, nullptr);
  }
  fewer.resize(kept);
  mesh.indices = fewer;
}

// Only the vertices that are used, in the order of their use.
void compact(PageMesh& mesh) {
  std::vector<float> used(mesh.positions.size());
  const std::size_t count =
      meshopt_optimizeVertexFetch(used.data(), mesh.indices.data(), mesh.indices.size(), mesh.positions.data(),
                                  mesh.positions.size() / 3, 3 * sizeof(float));
  used.resize(3 * count);
  mesh.positions = used;
}

Json mesh_json(const Mesh& mesh, const PreparedObject& frame, std::size_t most_triangles) {
  PageMesh shown = page_mesh(mesh, frame);
  if (shown.indices.size() > 3 * most_triangles) {
    simplify(shown, most_triangles);
  }
  compact(shown);
  std::vector<std::int16_t> points;
  for (const float value : shown.positions) {
    points.push_back(short_number(static_cast<double>(value) / kFarthest));
  }
  const std::vector<std::uint16_t> triangles(shown.indices.begin(), shown.indices.end());
  return {{"points", base64_of(points)}, {"triangles", base64_of(triangles)}, {"of", mesh.triangles.size()}};
}

Json cloud_json(std::span<const Vec3> all, const PreparedObject& frame, std::size_t most) {
  std::vector<std::int16_t> points;
  const std::size_t count = std::min(all.size(), most);
  for (std::size_t k = 0; k < count; ++k) {
    add_place(placed(all[k * all.size() / count], frame), points);
  }
  return {{"points", base64_of(points)}, {"of", all.size()}};
}

}  // namespace

Json shape_json(const Object& object, const PreparedObject& prepared, std::size_t most_bytes) {
  constexpr std::size_t kMostTriangles = std::numeric_limits<std::uint16_t>::max() / 3;  // whatever their corners share
  const auto* mesh = std::get_if<Mesh>(&object);
  if (mesh != nullptr && !mesh->triangles.empty()) {
    return mesh_json(*mesh, prepared, std::min(most_bytes / kTriangleBytes, kMostTriangles));
  }
  return cloud_json(mesh != nullptr ? mesh->vertices : std::get<PointCloud>(object).points, prepared,
                    most_bytes / kPointBytes);
}

std::string base64_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles, const PreparedObject& prepared,
                             std::size_t most) {
  std::vector<std::int16_t> numbers;
  for (const std::uint32_t f : triangles.first(std::min(most, triangles.size()))) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      add_place(placed(mesh.vertices[v], prepared), numbers);
    }
  }
  return base64_of(numbers);
}

std::string base64_positions(const OrientedPoints& points, std::size_t count) {
  std::vector<std::int16_t> numbers;
  for (std::size_t k = 0; k < count; ++k) {
    add_place(points.position(k).cast<double>(), numbers);
  }
  return base64_of(numbers);
}

std::string base64_normals(const OrientedPoints& points, std::size_t count) {
  std::vector<std::int16_t> numbers;
  for (std::size_t k = 0; k < count; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      numbers.push_back(short_number(static_cast<double>(points.normal(k)[axis])));
    }
  }
  return base64_of(numbers);
}

}  // namespace spincat
