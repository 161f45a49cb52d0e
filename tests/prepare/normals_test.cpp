#include "spincat/prepare/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shapes.h"

namespace spincat {
namespace {

using Points = std::vector<Vec3>;

void expect_near(const Vec3& found, const Vec3& expected, double tolerance = 1e-12) {
  EXPECT_LE((found - expected).norm(), tolerance) << found.transpose() << " instead of " << expected.transpose();
}

// Along the line of `expected`, either way.
void expect_parallel(const Vec3& found, const Vec3& expected, double tolerance) {
  EXPECT_NEAR(found.norm(), 1.0, 1e-12);
  EXPECT_LE(found.cross(expected).norm(), tolerance) << found.transpose() << " not along " << expected.transpose();
}

TEST(FaceAreaNormals, PointOutOfABoxWithTheAreaAsLength) {
  const Mesh mesh = test::box(2, 3, 4);
  const std::vector<Vec3> normals = face_area_normals(mesh);
  ASSERT_EQ(normals.size(), 12U);
  const Vec3 half_side(6, 4, 3);
  for (std::size_t f = 0; f < 12; ++f) {
    expect_near(normals[f], test::box_normal(f).cwiseProduct(half_side));
  }
}

TEST(FaceAreaNormals, AreZeroWithoutArea) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}, {2, 2, 2}}};
  for (const Vec3& n : face_area_normals(mesh)) {
    EXPECT_EQ(n, Vec3(0, 0, 0));
  }
}

TEST(VertexNormals, AreTheAreaWeightedMean) {
  // Around corner 0 of a box lie one or two triangles of each of three sides; the test weighs them itself.
  const Mesh mesh = test::box(2, 3, 4);
  const std::vector<Vec3> normals = vertex_normals(mesh);
  for (std::uint32_t v = 0; v < 8; ++v) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t f = 0; f < 12; ++f) {
      if (std::ranges::count(mesh.triangles[f], v) > 0) {
        sum += test::box_normal(f).cwiseProduct(Vec3(6, 4, 3));
      }
    }
    expect_near(normals[v], sum.normalized());
  }
}

TEST(VertexNormals, SplitVerticesChangeNothing) {
  const Mesh mesh = test::box(2, 3, 4);
  const std::vector<Vec3> whole = vertex_normals(mesh);
  const std::vector<Vec3> split = vertex_normals(test::soup_of(mesh));
  for (std::size_t f = 0; f < 12; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      expect_near(split[3 * f + k], whole[mesh.triangles[f][k]]);
    }
  }
}

TEST(VertexNormals, AFlippedFaceCountsAgainstItsNeighbours) {
  // Two triangles of one square: together (0, 0, 1); with one flipped they cancel where they meet.
  Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}}};
  const std::vector<Vec3> normals = vertex_normals(square);
  expect_near(normals[0], {0, 0, 1});  // cancelled: the default
  expect_near(normals[1], {0, 0, 1});
  expect_near(normals[3], {0, 0, -1});
}

TEST(VertexNormals, AnUnusedVertexPointsUp) {
  const Mesh mesh{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {5, 5, 5}}, {{0, 1, 2}}};
  expect_near(vertex_normals(mesh)[3], {0, 0, 1});
  expect_near(vertex_normals(mesh)[0], {0, 0, -1});
}

TEST(EstimatedNormals, OfAPlaneAreExact) {
  Points points;
  const Vec3 n = Vec3(1, 2, 3).normalized();
  const Vec3 u = Vec3(2, -1, 0).normalized();
  const Vec3 v = n.cross(u);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      points.emplace_back(i * u + 1.5 * j * v);
    }
  }
  for (const Vec3& found : estimated_normals(points, 9)) {
    expect_parallel(found, n, 1e-9);
  }
}

TEST(EstimatedNormals, OfASphereAreRadial) {
  const Points points = test::sphere_points(2000);
  const std::vector<Vec3> normals = estimated_normals(points, 24);
  for (std::size_t i = 0; i < points.size(); ++i) {
    expect_parallel(normals[i], points[i], 0.05);  // 24 of 2,000 points: a cap of radius 0.22
  }
}

TEST(EstimatedNormals, OfACylinderAreRadialAwayFromItsEnds) {
  Points points;
  for (int ring = 0; ring < 20; ++ring) {
    for (int k = 0; k < 40; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.5 * (ring % 2)) / 40;
      points.emplace_back(std::cos(angle), std::sin(angle), 0.15 * ring);
    }
  }
  const std::vector<Vec3> normals = estimated_normals(points, 12);
  for (std::size_t i = 200; i < 600; ++i) {
    expect_parallel(normals[i], {points[i].x(), points[i].y(), 0.0}, 0.05);
  }
}

TEST(EstimatedNormals, OfCollinearPointsArePerpendicularToTheLine) {
  const Vec3 along = Vec3(1, 2, -2) / 3.0;
  for (const int count : {2, 3, 10}) {
    Points points;
    for (int i = 0; i < count; ++i) {
      points.emplace_back(i * along);
    }
    for (const Vec3& n : estimated_normals(points, 24)) {
      EXPECT_NEAR(n.norm(), 1.0, 1e-12);
      EXPECT_NEAR(n.dot(along), 0.0, 1e-7);
    }
  }
}

TEST(EstimatedNormals, AreUnitVectorsWhereTheyAreNotDefined) {
  for (const Points& points : {Points{}, Points{{1, 2, 3}}, Points(30, Vec3(1, 2, 3))}) {
    const std::vector<Vec3> normals = estimated_normals(points, 24);
    EXPECT_EQ(normals.size(), points.size());
    for (const Vec3& n : normals) {
      EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    }
  }
}

TEST(OrientTowards, TurnsToTheSensor) {
  const Points points = {{0, 0, 0}, {0, 0, 2}, {0, 0, 0}};
  std::vector<Vec3> normals = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}};
  orient_towards(points, {0, 0, 1}, normals);
  EXPECT_EQ(normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}}));  // across the view: left alone
}

TEST(OrientOutwards, TurnsAwayFromTheCentroid) {
  const Points points = {{-1, 0, 0}, {1, 0, 0}, {0, 5, 0}, {0, -5, 0}};
  std::vector<Vec3> normals = {{1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {1, 0, 0}};
  orient_outwards(points, normals);
  EXPECT_EQ(normals, (std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
}

TEST(OrientOutwards, UsesTheCentroidNotTheOrigin) {
  const Points points = {{10, 0, 0}, {12, 0, 0}};
  std::vector<Vec3> normals = {{1, 0, 0}, {-1, 0, 0}};
  orient_outwards(points, normals);
  EXPECT_EQ(normals, (std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}}));
}

TEST(OrientOutwards, OfNothingIsDefined) {
  orient_outwards({}, {});
}

}  // namespace
}  // namespace spincat
