#include "spincat/evaluate/split_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "spincat/prepare/normals.h"
#include "support/shapes.h"

namespace spincat {
namespace {

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const Vec3& n : face_area_normals(mesh)) {
    area += n.norm();
  }
  return area;
}

double longest_edge(const Mesh& mesh) {
  double longest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
    }
  }
  return longest;
}

// How many edges are of one triangle, or of two that run along it the same way.
std::size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      ways[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return static_cast<std::size_t>(std::ranges::count_if(ways, [](const auto& edge) { return edge.second != 0; }));
}

TEST(WithSplitEdges, OneSplitOfASquareHalvesBothTriangles) {
  const Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Mesh split = with_split_edges(square, 3, 1e-9);
  EXPECT_EQ(split.vertices.size(), 5U);
  EXPECT_EQ(split.vertices[4], Vec3(0.5, 0.5, 0));
  ASSERT_EQ(split.triangles.size(), 4U);
  for (const Vec3& n : face_area_normals(split)) {
    EXPECT_EQ(n, Vec3(0, 0, 0.25));
  }
}

TEST(WithSplitEdges, AClosedMeshStaysClosedAndKeepsItsSurface) {
  for (const Mesh& mesh : {test::box(1, 2, 3), test::icosphere(1), test::cylinder(9, 1.0, 0.5, 4.0)}) {
    for (const Mesh& given : {mesh, test::soup_of(mesh)}) {
      const Mesh dense = with_split_edges(given, 2'000, 1e-9);
      EXPECT_GE(dense.triangles.size(), 2'000U);
      EXPECT_LT(dense.triangles.size(), 2'010U);
      EXPECT_EQ(open_edges(dense), 0U);
      EXPECT_NEAR(area_of(dense), area_of(mesh), 1e-9 * area_of(mesh));
    }
  }
}

TEST(WithSplitEdges, NoEdgeIsLongerThanTheLength) {
  const Mesh fine = with_split_edges(test::box(1, 2, 3), kAny, 0.3);
  EXPECT_LE(longest_edge(fine), 0.3);
  EXPECT_GT(longest_edge(fine), 0.15);
  EXPECT_EQ(open_edges(fine), 0U);
}

TEST(WithSplitEdges, WhatIsDenseEnoughStaysAsItIs) {
  const Mesh ball = test::icosphere(2);
  const Mesh same = with_split_edges(ball, 100, 1e-9);
  EXPECT_EQ(same.vertices, ball.vertices);
  EXPECT_EQ(same.triangles, ball.triangles);
}

TEST(WithSplitEdges, TrianglesWithoutAreaAndUnusedVerticesAreLeftOut) {
  const Mesh mesh{{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {{0, 2, 3}, {0, 4, 2}, {2, 2, 2}}};
  const Mesh same = with_split_edges(mesh, 1, 1e-9);
  EXPECT_EQ(same.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(same.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(with_split_edges({}, 5, 1e-9).triangles.empty());
}

}  // namespace
}  // namespace spincat
