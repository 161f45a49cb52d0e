#include "spincat/prepare/resolution.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

TEST(MeshResolution, IsTheMedianEdge) {
  const Mesh triangle{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(mesh_resolution(triangle), 4.0);
}

TEST(MeshResolution, CountsAnEdgeOnceHoweverManyFacesShareIt) {
  // Edges 1 (shared by three faces and one repeated), 5, 5, 6, 6, 7, 7: the median is 6, not 5.
  const double h = 0.5;
  Mesh fan{{{-h, 0, 0}, {h, 0, 0}}, {}};
  for (const double r : {5.0, 6.0, 7.0}) {
    fan.vertices.emplace_back(0.0, std::sqrt(r * r - h * h), 0.0);
    const auto tip = static_cast<std::uint32_t>(fan.vertices.size() - 1);
    fan.triangles.push_back({0, 1, tip});
  }
  fan.triangles.push_back({1, 0, 2});
  EXPECT_DOUBLE_EQ(mesh_resolution(fan), 6.0);
}

TEST(MeshResolution, OfACubeIsItsEdge) {
  EXPECT_DOUBLE_EQ(mesh_resolution(test::box(2, 2, 2)), 2.0);
}

TEST(MeshResolution, TakesTheUpperOfTheTwoMiddleOnes) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {10, 0, 0}, {12, 0, 0}}, {{0, 1, 1}, {2, 3, 3}}};
  EXPECT_EQ(mesh_resolution(mesh), 2.0);
}

TEST(MeshResolution, LeavesOutEdgesWithoutLength) {
  const Mesh mesh{{{0, 0, 0}, {0, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}};
  EXPECT_EQ(mesh_resolution(mesh), 3.0);
  EXPECT_EQ(mesh_resolution({{{1, 1, 1}}, {{0, 0, 0}}}), 0.0);
  EXPECT_EQ(mesh_resolution({}), 0.0);
}

TEST(CloudResolution, IsTheMedianDistanceToTheNearestOther) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}, {20, 0, 0}};
  EXPECT_DOUBLE_EQ(cloud_resolution(points), 2.0);  // 1, 1, 2, 4, 13
}

TEST(CloudResolution, OfFewerThanTwoPointsIsZero) {
  EXPECT_EQ(cloud_resolution({}), 0.0);
  EXPECT_EQ(cloud_resolution(std::vector<Vec3>{{1, 2, 3}}), 0.0);
}

TEST(ObjectResolution, IsThatOfTheMeshOrOfTheDistinctPoints) {
  EXPECT_DOUBLE_EQ(object_resolution(test::box(1, 2, 2)),
                   2.0);  // 4 edges of 1, 8 of 2, 4 diagonals sqrt 5, 2 of sqrt 8
  EXPECT_DOUBLE_EQ(object_resolution(PointCloud{{{0, 0, 0}, {10, 0, 0}, {30, 0, 0}, {0, 0, 0}}, {}, {}}), 10.0);
  // Without area: the cloud of its vertices.
  EXPECT_DOUBLE_EQ(object_resolution(Mesh{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1, 2}}}), 1.0);
}

TEST(ObjectResolution, FollowsAnyUnit) {
  const Mesh mesh = test::cylinder(12, 1.0, 0.5, 3.0);
  for (const double unit : {0x1p-600, 0x1p-100, 0x1p100, 0x1p600}) {
    EXPECT_DOUBLE_EQ(object_resolution(test::scaled(mesh, unit)), unit * object_resolution(mesh));
  }
}

TEST(ObjectResolution, NeedsAnExtent) {
  EXPECT_EQ(test::input_error([] { object_resolution(PointCloud{}); }), "holds no points");
}

}  // namespace
}  // namespace spincat
