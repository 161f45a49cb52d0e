#include "spincat/prepare/facts.h"

#include <algorithm>
#include <cstdint>
#include <variant>
#include <vector>

#include "spincat/prepare/defects.h"
#include "spincat/prepare/dust.h"
#include "spincat/prepare/lone_points.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/repeats.h"
#include "spincat/prepare/resolution.h"

namespace spincat {
namespace {

std::size_t count_repeated(std::span<const std::uint32_t> first) {
  std::size_t repeated = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    repeated += first[i] != i ? 1 : 0;
  }
  return repeated;
}

std::size_t count_dust(const Mesh& used) {
  return all_at_one_place(used.vertices) ? 0 : dust_of(transformed(used, unit_similarity(used.vertices))).size();
}

void find_box(std::span<const Vec3> points, ObjectFacts& facts) {
  facts.low = facts.high = points.front();
  for (const Vec3& p : points) {
    facts.low = facts.low.cwiseMin(p);
    facts.high = facts.high.cwiseMax(p);
  }
}

void add_mesh_facts(const Mesh& mesh, ObjectFacts& facts) {
  facts.triangles = mesh.triangles.size();
  const Mesh used = without_unused_vertices(mesh);
  facts.unused_vertices = mesh.vertices.size() - used.vertices.size();
  facts.dust_triangles = count_dust(used);
  find_box(used.vertices.empty() ? mesh.vertices : used.vertices, facts);
  for (const Vec3& normal : face_area_normals(mesh)) {
    facts.area += normal.norm();
  }
  const MeshDefects defects = defects_of(mesh);
  facts.flat_triangles = defects.flat.size();
  facts.repeated_triangles = defects.repeated.size();
  facts.flipped_triangles = defects.flipped.size();
  facts.resolution = mesh_resolution(mesh);
}

std::vector<Vec3> distinct(std::span<const Vec3> points, std::span<const std::uint32_t> first) {
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] == i) {
      result.push_back(points[i]);
    }
  }
  return result;
}

}  // namespace

ObjectFacts facts_of(const Object& object) {
  ObjectFacts facts;
  const auto* mesh = std::get_if<Mesh>(&object);
  const std::vector<Vec3>& points = mesh != nullptr ? mesh->vertices : std::get<PointCloud>(object).points;
  facts.is_mesh = mesh != nullptr;
  facts.points = points.size();
  facts.unfinite_points = (mesh != nullptr ? mesh->left_out : std::get<PointCloud>(object).left_out).size();
  const std::vector<std::uint32_t> first = first_at_position(points);
  facts.repeated_points = count_repeated(first);
  if (mesh != nullptr) {
    add_mesh_facts(*mesh, facts);
  } else {
    const auto& cloud = std::get<PointCloud>(object);
    facts.has_normals = !cloud.normals.empty();
    facts.lone_points = points.size() - facts.repeated_points - without_lone_points(cloud).points.size();
    facts.resolution = cloud_resolution(distinct(points, first));
    find_box(points, facts);
  }
  return facts;
}

}  // namespace spincat
