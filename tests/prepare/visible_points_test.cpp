#include "spincat/prepare/visible_points.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/shapes.h"

namespace spincat {
namespace {

constexpr double kRadius = 0.1;

SurfacePoints visible_of(const SurfacePoints& points, std::uint64_t seed = 1) {
  Random random(seed);
  return visible_points({points, std::vector<double>(points.positions.size(), kRadius)}, random).points;
}

// A sphere of so large a radius whose normals look out and in by turns.
SurfacePoints sphere(double radius, int count = 1500) {
  SurfacePoints points;
  for (const Vec3& p : test::sphere_points(count)) {
    points.positions.emplace_back(radius * p);
    points.normals.emplace_back(points.normals.size() % 2 == 0 ? p : Vec3(-p));
  }
  return points;
}

TEST(VisiblePoints, LookOutOfASphere) {
  const SurfacePoints visible = visible_of(sphere(1.0));
  ASSERT_EQ(visible.positions.size(), 1500U);
  for (std::size_t i = 0; i < visible.positions.size(); ++i) {
    EXPECT_GT(visible.positions[i].dot(visible.normals[i]), 0.99);
  }
}

TEST(VisiblePoints, AreNotThoseInside) {
  SurfacePoints points = sphere(1.0);
  const SurfacePoints inner = sphere(0.5, 200);
  points.positions.insert(points.positions.end(), inner.positions.begin(), inner.positions.end());
  points.normals.insert(points.normals.end(), inner.normals.begin(), inner.normals.end());
  EXPECT_EQ(visible_of(points).positions.size(), 1500U);
}

TEST(VisiblePoints, AreOnBothSidesOfAThinBoard) {
  SurfacePoints board;
  for (int i = -12; i <= 12; ++i) {
    for (int k = -12; k <= 12; ++k) {
      board.positions.emplace_back(0.05 * i, 0.05 * k, 0.0);
      board.normals.emplace_back(0, 0, 1);
    }
  }
  const SurfacePoints visible = visible_of(board);
  EXPECT_EQ(visible.positions.size(), 2 * board.positions.size());
  Vec3 sum = Vec3::Zero();
  for (const Vec3& n : visible.normals) {
    sum += n;
  }
  EXPECT_EQ(sum, Vec3(0, 0, 0));
}

TEST(VisiblePoints, AreTheSameForOneSeed) {
  const SurfacePoints points = sphere(1.0);
  EXPECT_EQ(visible_of(points, 3).positions, visible_of(points, 3).positions);
  EXPECT_EQ(visible_of(points, 3).normals, visible_of(points, 3).normals);
}

TEST(VisiblePoints, OfNothingAreNone) {
  EXPECT_TRUE(visible_of({}).positions.empty());
}

}  // namespace
}  // namespace spincat
