#include "spincat/prepare/facts.h"

#include <gtest/gtest.h>

#include "spincat/prepare/repeats.h"
#include "support/shapes.h"

namespace spincat {
namespace {

TEST(FirstAtPosition, NamesTheFirstOfEachPosition) {
  const std::vector<Vec3> points = {{2, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 1e-300}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(first_at_position(points), (std::vector<std::uint32_t>{0, 1, 0, 3, 1, 0}));
  EXPECT_TRUE(first_at_position({}).empty());
}

TEST(FirstAtPosition, MinusZeroIsZero) {
  const std::vector<Vec3> points = {{0.0, -0.0, 1}, {1, 1, 1}, {-0.0, 0.0, 1}};
  EXPECT_EQ(first_at_position(points), (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(Facts, OfASoundMesh) {
  const ObjectFacts facts = facts_of(test::box(1, 2, 3));
  EXPECT_TRUE(facts.is_mesh);
  EXPECT_EQ(facts.points, 8U);
  EXPECT_EQ(facts.triangles, 12U);
  EXPECT_EQ(facts.repeated_points + facts.unused_vertices + facts.flat_triangles + facts.repeated_triangles +
                facts.flipped_triangles,
            0U);
  EXPECT_EQ(facts.low, Vec3(-0.5, -1.0, -1.5));
  EXPECT_EQ(facts.high, Vec3(0.5, 1.0, 1.5));
  EXPECT_DOUBLE_EQ(facts.area, 22.0);
}

TEST(Facts, CountsDefects) {
  Mesh mesh = test::box(1, 2, 3);
  mesh.vertices.push_back(mesh.vertices[0]);  // 8: repeated, used by the repeated face below
  mesh.vertices.emplace_back(9, 9, 9);        // 9: unused
  mesh.vertices.emplace_back(9, 9, 9);        // 10: repeated and unused
  mesh.triangles.push_back({4, 6, 8});        // the first face again, by another vertex and another corner first
  mesh.triangles.push_back({0, 6, 4});        // and flipped
  mesh.triangles.push_back({0, 0, 1});        // flat
  mesh.triangles.push_back({0, 0, 1});        // flat again: not counted as repeated
  const ObjectFacts facts = facts_of(mesh);
  EXPECT_EQ(facts.points, 11U);
  EXPECT_EQ(facts.triangles, 16U);
  EXPECT_EQ(facts.repeated_points, 2U);
  EXPECT_EQ(facts.unused_vertices, 2U);
  EXPECT_EQ(facts.flat_triangles, 2U);
  EXPECT_EQ(facts.repeated_triangles, 2U);
  EXPECT_DOUBLE_EQ(facts.area, 22.0 + 2 * 3.0);
  EXPECT_EQ(facts.high, Vec3(0.5, 1.0, 1.5)) << "what no triangle uses is no part of the object";
}

TEST(Facts, CountsWhatLiesFarFromTheObject) {
  Mesh mesh = test::icosphere(2);
  mesh.vertices.insert(mesh.vertices.end(), {{30, 0, 0}, {30, 0.01, 0}, {30, 0, 0.01}});
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  mesh.triangles.push_back({last - 2, last - 1, last});
  EXPECT_EQ(facts_of(mesh).dust_triangles, 1U);
  EXPECT_EQ(facts_of(mesh).high.x(), 30.0) << "the box is the file's";
  PointCloud cloud{test::icosphere(3).vertices, {}, {}};
  cloud.points.emplace_back(0, 0, 0);
  cloud.points.emplace_back(0, 0, 0);
  cloud.points.emplace_back(0, 30, 0);
  EXPECT_EQ(facts_of(cloud).lone_points, 2U);
  EXPECT_EQ(facts_of(cloud).repeated_points, 1U);
}

TEST(Facts, OfACloud) {
  const PointCloud cloud{{{0, 0, 0}, {4, 0, 0}, {4, 0, 0}, {6, 0, 0}}, {}, {}};
  const ObjectFacts facts = facts_of(cloud);
  EXPECT_FALSE(facts.is_mesh);
  EXPECT_FALSE(facts.has_normals);
  EXPECT_EQ(facts.points, 4U);
  EXPECT_EQ(facts.repeated_points, 1U);
  EXPECT_EQ(facts.triangles, 0U);
  EXPECT_DOUBLE_EQ(facts.resolution, 2.0);  // 4, 2, 2: the repeated point counts once
  EXPECT_TRUE(facts_of(PointCloud{{{0, 0, 0}}, {{0, 0, 1}}, {}}).has_normals);
  EXPECT_EQ(facts.unfinite_points, 0U);
  EXPECT_EQ(facts_of(PointCloud{cloud.points, {}, {}, {2, 5}}).unfinite_points, 2U);
}

}  // namespace
}  // namespace spincat
