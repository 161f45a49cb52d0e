// Shapes that tests are made of. Their faces run counter-clockwise seen from outside.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat::test {

// A box around the origin: corner k has bit 0 of k for +x, bit 1 for +y, bit 2 for +z. Two triangles a side; the faces
// 2 s and 2 s + 1 are side s, in the order -x, +x, -y, +y, -z, +z.
inline Mesh box(double x = 1.0, double y = 1.0, double z = 1.0) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.emplace_back((k & 1) != 0 ? x / 2 : -x / 2, (k & 2) != 0 ? y / 2 : -y / 2,
                               (k & 4) != 0 ? z / 2 : -z / 2);
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

// The normal of face `f` of a box.
inline Vec3 box_normal(std::size_t f) {
  Vec3 n = Vec3::Zero();
  n[static_cast<Eigen::Index>(f / 4)] = f / 2 % 2 == 0 ? -1.0 : 1.0;
  return n;
}

// An icosahedron, each face cut into four `times` times, on the unit sphere.
inline Mesh icosphere(int times) {
  const double t = std::numbers::phi;
  Mesh mesh;
  mesh.vertices = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int round = 0; round < times; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) {
        mesh.vertices.emplace_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      }
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& v : mesh.vertices) {
    v.normalize();
  }
  return mesh;
}

// Closed, around the z axis from 0 to `height`; with a radius of 0 at the top it is a cone.
inline Mesh cylinder(int sides, double bottom_radius, double top_radius, double height) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, height}};
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    mesh.vertices.emplace_back(bottom_radius * std::cos(angle), bottom_radius * std::sin(angle), 0.0);
    mesh.vertices.emplace_back(top_radius * std::cos(angle), top_radius * std::sin(angle), height);
    const std::uint32_t here = 2 + 2 * k;
    const std::uint32_t next = 2 + 2 * ((k + 1) % n);
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{0, next, here}, {1, here + 1, next + 1}, {here, next, next + 1}, {here, next + 1, here + 1}});
  }
  return mesh;
}

// Every triangle with vertices of its own, as STL files hold them.
inline Mesh soup_of(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) {
      soup.vertices.push_back(mesh.vertices[v]);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return mesh;
}

// Every second face turned round.
inline Mesh half_flipped(Mesh mesh) {
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 2) {
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  }
  return mesh;
}

inline Mesh scaled(Mesh mesh, double factor) {
  for (Vec3& v : mesh.vertices) {
    v *= factor;
  }
  return mesh;
}

inline Mesh turned(Mesh mesh, const Eigen::Quaterniond& rotation) {
  for (Vec3& v : mesh.vertices) {
    v = rotation * v;
  }
  return mesh;
}

// `count` points spread evenly over the unit sphere, on a spiral.
inline std::vector<Vec3> sphere_points(int count) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / count;
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * k;
    points.emplace_back(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z);
  }
  return points;
}

inline std::string off_text(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) {
    text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  }
  for (const Triangle& t : mesh.triangles) {
    text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  }
  return text;
}

}  // namespace spincat::test
