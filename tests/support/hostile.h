// Objects that a reader lets through and that no sensible program would have written.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "spincat/geometry/random.h"
#include "support/shapes.h"

namespace spincat::test {

struct HostileObject {
  std::string name;
  Object object;
  bool refused = false;  // has no extent: is refused in words by everything
};

inline Vec3 random_vector(Random& random, double size) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

// Triangles that cut each other everywhere.
inline Mesh tangled_soup(int triangles) {
  Random random(7);
  Mesh mesh;
  for (int t = 0; t < triangles; ++t) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) {
      mesh.vertices.push_back(random_vector(random, 1.0));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// One triangle, and specks of dust a billionth of its size.
inline Mesh giant_beside_dust() {
  Mesh mesh{{{0, 0, 0}, {1e6, 0, 0}, {0, 1e6, 0}}, {{0, 1, 2}}};
  Random random(8);
  for (int k = 0; k < 200; ++k) {
    Mesh speck = scaled(box(), 1e-3);
    const Vec3 place = random_vector(random, 1.0);
    for (Vec3& v : speck.vertices) {
      v += place;
    }
    mesh = joined(mesh, speck);
  }
  return mesh;
}

inline std::vector<Vec3> on_a_line(int count, const Vec3& direction) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    points.emplace_back(direction * k);
  }
  return points;
}

inline std::vector<Vec3> times(std::vector<Vec3> points, double factor) {
  for (Vec3& p : points) {
    p *= factor;
  }
  return points;
}

// A ball's points, with normals of which every second one is not a number, or all are nothing or immense.
inline PointCloud with_normals(double value, bool all) {
  PointCloud cloud{sphere_points(300), {}, {}};
  cloud.normals = cloud.points;
  for (std::size_t i = 0; i < cloud.normals.size(); i += all ? 1 : 2) {
    cloud.normals[i] = Vec3::Constant(value);
  }
  return cloud;
}

inline std::vector<HostileObject> hostile_clouds() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> ball = sphere_points(300);
  std::vector<Vec3> outlier = ball;
  outlier.emplace_back(1e30, -1e30, 1e30);
  std::vector<Vec3> repeated = ball;
  repeated.insert(repeated.end(), 1'000'000, ball[5]);
  std::vector<Vec3> far = ball;
  for (Vec3& p : far) {
    p += Vec3(1e17, -1e17, 1e17);  // where doubles are 16 apart
  }
  return {{"cloud of 1e30", PointCloud{times(ball, 1e30), {}, {}}},
          {"cloud of 1e-30", PointCloud{times(ball, 1e-30), {}, {}}},
          {"cloud of 1e300", PointCloud{times(ball, 1e300), {}, {}}},
          {"cloud and a point at 1e30", PointCloud{outlier, {}, {}}},
          {"cloud at one place", PointCloud{std::vector<Vec3>(300, Vec3(1, 2, 3)), {}, {}}, true},
          {"no points", PointCloud{}, true},
          {"one point", PointCloud{{{1, 2, 3}}, {}, {}}, true},
          {"two points", PointCloud{{{0, 0, 0}, {0, 0, 1}}, {}, {}}},
          {"cloud far away at one place", PointCloud{far, {}, {}}, true},
          {"points on a line", PointCloud{on_a_line(400, {1, 2, 3}), {}, {}}},
          {"points on an axis", PointCloud{on_a_line(400, {0, 0, 1e-30}), {}, {}}},
          {"a point a million times", PointCloud{repeated, {}, {}}},
          {"normals not numbers", with_normals(kNaN, true)},
          {"some normals not numbers", with_normals(kNaN, false)},
          {"some normals infinite", with_normals(kInfinity, false)},
          {"normals of 1e300", with_normals(1e300, true)},
          {"normals of 1e-320", with_normals(1e-320, true)},
          {"normals of nothing", with_normals(0.0, true)},
          {"sensor at 1e30", PointCloud{ball, {}, Vec3(1e30, 1e30, 1e30)}},
          {"sensor among the points", PointCloud{ball, {}, ball[0]}}};
}

inline std::vector<HostileObject> hostile_meshes() {
  const Mesh ball = icosphere(2);
  Mesh line{on_a_line(50, {1, 2, 3}), {}};
  for (std::uint32_t k = 2; k < 50; ++k) {
    line.triangles.push_back({k - 2, k - 1, k});
  }
  Mesh repeated = box();
  repeated.triangles.insert(repeated.triangles.end(), 20'000, repeated.triangles[0]);
  Mesh corners = box();
  corners.vertices.insert(corners.vertices.end(), 1'000'000, corners.vertices[0]);
  Mesh shell = icosphere(1);
  for (int k = 1; k < 30; ++k) {
    shell = joined(shell, scaled(icosphere(1), 1.0 - k * 1e-9));
  }
  return {
      {"mesh of 1e30", scaled(ball, 1e30)},
      {"mesh of 1e-30", scaled(ball, 1e-30)},
      {"mesh of 1e-200", scaled(ball, 1e-200)},
      {"mesh and a triangle of 1e30", joined(ball, scaled(Mesh{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}}, 1e30))},
      {"mesh at one place", Mesh{std::vector<Vec3>(30, Vec3(1, 2, 3)), {{0, 1, 2}, {3, 4, 5}}}, true},
      {"no triangles and no points", Mesh{}, true},
      {"triangles on a line", line},
      {"needle", Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1e-300, 0}}, {{0, 1, 2}}}},
      {"one triangle", Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}},
      {"a triangle 20,000 times", repeated},
      {"an unused corner a million times", corners},
      {"thirty shells in one", shell},
      {"giant beside dust", giant_beside_dust()},
      {"tangled soup", tangled_soup(3'000)},
      {"half flipped", half_flipped(ball)}};
}

inline std::vector<HostileObject> hostile_objects() {
  std::vector<HostileObject> all = hostile_clouds();
  for (HostileObject& mesh : hostile_meshes()) {
    all.push_back(std::move(mesh));
  }
  return all;
}

}  // namespace spincat::test
