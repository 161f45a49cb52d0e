#include "spincat/prepare/normalise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/expect_error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using test::input_error;
using Points = std::vector<Vec3>;

double furthest(const Points& points) {
  double result = 0.0;
  for (const Vec3& p : points) {
    result = std::max(result, p.norm());
  }
  return result;
}

TEST(UnitSimilarity, CentresTheBoundingBoxNotTheCentroid) {
  const Points points = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {5, 0, 0}, {3, 4, 0}};
  const Similarity s = unit_similarity(points);
  EXPECT_EQ(s.centre, Vec3(3, 2, 0));
  EXPECT_DOUBLE_EQ(s.factor, 1.0 / std::sqrt(8.0));  // (1, 0, 0) and (5, 0, 0) are the furthest
  EXPECT_NEAR((s({5, 0, 0}) - Vec3(2, -2, 0) / std::sqrt(8.0)).norm(), 0.0, 1e-15);
}

class CoordinatesOfSize : public testing::TestWithParam<double> {};

TEST_P(CoordinatesOfSize, AreBroughtToUnitSize) {
  const double size = GetParam();
  const Mesh mesh = test::scaled(test::box(1, 2, 3), size);
  const Similarity s = unit_similarity(mesh.vertices);
  const Mesh unit = transformed(mesh, s);
  EXPECT_NEAR(furthest(unit.vertices), 1.0, 1e-12);
  EXPECT_NEAR(s.factor * size, 2.0 / std::sqrt(14.0), 1e-12);
  EXPECT_NEAR((unit.vertices[7] - Vec3(1, 2, 3) / std::sqrt(14.0)).norm(), 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Sizes, CoordinatesOfSize, testing::Values(1e-300, 1e-30, 1e-3, 1.0, 1e30, 1e300));

TEST(UnitSimilarity, KeepsASmallShapeFarFromTheOrigin) {
  const Points points = {{1e6, 1e6, 0}, {1e6 + 2, 1e6, 0}};
  const Similarity s = unit_similarity(points);
  EXPECT_EQ(s(points[0]), Vec3(-1, 0, 0));
  EXPECT_EQ(s(points[1]), Vec3(1, 0, 0));
}

TEST(UnitSimilarity, RefusesWhatHasNoExtent) {
  EXPECT_EQ(input_error([] { unit_similarity({}); }), "holds no points");
  EXPECT_EQ(input_error([] { unit_similarity(Points{{1, 2, 3}}); }), "holds only one point");
  EXPECT_EQ(input_error([] { unit_similarity(Points(7, Vec3(1e30, 2, 3))); }), "all its points are at one place");
}

TEST(UnitSimilarity, GivesNoNumbersThatAreNotFinite) {
  const double most = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  for (const Points& points : {Points{{-most, -most, -most}, {most, most, most}}, Points{{0, 0, 0}, {least, 0, 0}},
                               Points{{-most, 0, 0}, {most, 0, 0}}}) {
    try {
      const Similarity s = unit_similarity(points);
      EXPECT_TRUE(s(points[0]).allFinite());
      EXPECT_NEAR(s(points[0]).norm(), 1.0, 1e-6);
    } catch (const InputError& error) {
      EXPECT_FALSE(error.problem().empty());
    }
  }
}

TEST(WithoutUnusedVertices, KeepsTheOrderOfTheOthers) {
  const Mesh mesh{{{9, 9, 9}, {0, 0, 0}, {8, 8, 8}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}}, {{4, 1, 3}, {1, 3, 4}}};
  const Mesh used = without_unused_vertices(mesh);
  EXPECT_EQ(used.vertices, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(used.triangles, (std::vector<Triangle>{{2, 0, 1}, {0, 1, 2}}));
}

TEST(WithoutUnusedVertices, LeavesNothingOfAMeshWithoutTriangles) {
  EXPECT_TRUE(without_unused_vertices({{{1, 2, 3}}, {}}).vertices.empty());
}

TEST(Transformed, MovesTheSensorAndLeavesNormals) {
  const PointCloud cloud{{{2, 0, 0}, {4, 0, 0}}, {{0, 0, 5}, {0, 1, 0}}, Vec3(3, 0, 7)};
  const PointCloud unit = transformed(cloud, {Vec3(3, 0, 0), 2.0});
  EXPECT_EQ(unit.points, (Points{{-2, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(unit.normals, cloud.normals);
  EXPECT_EQ(unit.sensor, Vec3(0, 0, 14));
}

TEST(Stretched, KeepsNormalsPerpendicular) {
  // The plane x + y = 0 stretched by 2 along x becomes x / 2 + y = 0.
  const PointCloud cloud{{{1, -1, 0}}, {{1, 1, 0}}, Vec3(1, 1, 1)};
  const PointCloud wide = stretched(cloud, {2, 1, 3});
  EXPECT_EQ(wide.points[0], Vec3(2, -1, 0));
  EXPECT_EQ(wide.normals[0], Vec3(0.5, 1, 0));
  EXPECT_EQ(wide.sensor, Vec3(2, 1, 3));
}

TEST(Stretched, StretchesVerticesAndKeepsTriangles) {
  const Mesh mesh = stretched(test::box(), {2, 3, 4});
  EXPECT_EQ(mesh.vertices, test::box(2, 3, 4).vertices);
  EXPECT_EQ(mesh.triangles, test::box().triangles);
}

}  // namespace
}  // namespace spincat
