#include "spincat/prepare/dust.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spincat/prepare/as_cloud.h"
#include "spincat/prepare/prepare.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using Indices = std::vector<std::uint32_t>;

// Adds a triangle with legs of `size` at a place; where it stands in the list.
std::uint32_t add_speck(Mesh& mesh, const Vec3& place, double size) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {place, place + Vec3(size, 0, 0), place + Vec3(0, size, 0)});
  mesh.triangles.push_back({first, first + 1, first + 2});
  return static_cast<std::uint32_t>(mesh.triangles.size() - 1);
}

TEST(Dust, WholeShapesHaveNone) {
  EXPECT_EQ(dust_of(test::box(1, 2, 3)), Indices());
  EXPECT_EQ(dust_of(test::box(0.01, 0.01, 5)), Indices());
  EXPECT_EQ(dust_of(test::icosphere(3)), Indices());
  EXPECT_EQ(dust_of({}), Indices());
}

TEST(Dust, ASpeckFarAwayIsFound) {
  for (const double distance : {2.5, 30.0, 1e4}) {
    for (const double size : {1e-6, 1e-2}) {
      Mesh mesh = test::icosphere(2);
      mesh.triangles.insert(mesh.triangles.begin() + 4, mesh.triangles[0]);
      const std::uint32_t speck = add_speck(mesh, {0, distance, 0}, size);
      EXPECT_EQ(dust_of(mesh), Indices{speck}) << distance << " " << size;
    }
  }
}

TEST(Dust, ASpeckWithoutAreaIsDustToo) {
  Mesh mesh = test::icosphere(2);
  mesh.vertices.emplace_back(0, 0, 9);
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  mesh.triangles.push_back({last, last, last});
  EXPECT_EQ(dust_of(mesh), Indices{static_cast<std::uint32_t>(mesh.triangles.size() - 1)});
}

TEST(Dust, WhatIsNearOrHangsTogetherWithTheObjectStays) {
  Mesh near = test::icosphere(2);
  add_speck(near, {0, 1.8, 0}, 1e-3);
  EXPECT_EQ(dust_of(near), Indices());
  // An antenna of triangles, each with a corner at the place of one of the last: 10 radii long.
  Mesh antenna = test::icosphere(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 from(0, 0.9 + 0.1 * i, 0);
    const auto first = static_cast<std::uint32_t>(antenna.vertices.size());
    antenna.vertices.insert(antenna.vertices.end(), {from, from + Vec3(1e-4, 0, 0), from + Vec3(0, 0.1, 0)});
    antenna.vertices[first] = i == 0 ? antenna.vertices[antenna.triangles[0][0]] : antenna.vertices[first - 1];
    antenna.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(dust_of(antenna), Indices());
}

TEST(Dust, AFarPieceWithAShareOfTheAreaIsNone) {
  Mesh mesh = test::box(1, 1, 1);
  add_speck(mesh, {20, 0, 0}, 0.6);  // 0.18 of 6.18
  EXPECT_EQ(dust_of(mesh), Indices());
}

TEST(Dust, AMeshIsPreparedAsIfItWereNotThere) {
  const Mesh clean = test::box(1, 2, 3);
  Mesh dirty = clean;
  add_speck(dirty, {60, 0, 0}, 1e-3);
  dirty.vertices.emplace_back(0, 100, 0);  // and a vertex that no triangle uses
  for (const SurfaceKind surface : {SurfaceKind::external, SurfaceKind::samples, SurfaceKind::vertices}) {
    PrepareSettings settings;
    settings.surface = surface;
    const PreparedObject expected = prepare(clean, settings, 1);
    const PreparedObject prepared = prepare(dirty, settings, 1);
    EXPECT_EQ(prepared.scale, expected.scale);
    ASSERT_EQ(prepared.surface.size(), expected.surface.size());
    for (std::size_t i = 0; i < expected.surface.size(); ++i) {
      ASSERT_EQ(prepared.surface.position(i), expected.surface.position(i)) << i;
    }
  }
  EXPECT_EQ(as_cloud(dirty, 500, 0.01, 3).points, as_cloud(clean, 500, 0.01, 3).points);
}

TEST(WithoutTriangles, KeepsTheirVertices) {
  Mesh mesh = test::box();
  const Mesh clean = mesh;
  const std::uint32_t speck = add_speck(mesh, {9, 9, 9}, 1);
  const Mesh rest = without_triangles(mesh, {speck});
  EXPECT_EQ(rest.vertices, mesh.vertices);
  EXPECT_EQ(rest.triangles, clean.triangles);
}

}  // namespace
}  // namespace spincat
