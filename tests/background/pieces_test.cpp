#include "spincat/background/pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace spincat::background {
namespace {

// What a closed mesh encloses, whichever way its faces look.
double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  }
  return std::abs(sum) / 6.0;
}

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return sum;
}

void expect_vec(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR((a - b).norm(), 0.0, 1e-12) << a.transpose() << " and " << b.transpose();
}

TEST(Pieces, ABoxHasItsSize) {
  const Mesh mesh = box({1, 2, 3}, {2, 3, 4});
  EXPECT_NEAR(volume(moved(mesh, Vec3{-1, -2, -3})), 24.0, 1e-9);
  EXPECT_NEAR(area(mesh), 52.0, 1e-9);
  Vec3 low = mesh.vertices.front();
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
  }
  expect_vec(low, {0, 0.5, 1});
}

TEST(Pieces, ALatheOfFourSidesIsAPyramid) {
  EXPECT_NEAR(volume(lathe({{0, 0}, {1, 0}, {0, 3}}, 4)), 2.0, 1e-12);
}

TEST(Pieces, ARodIsClosed) {
  // A prism of ten sides on a unit circle.
  const double base = 5.0 * std::sin(2.0 * std::numbers::pi / 10);
  EXPECT_NEAR(volume(rod({1, 1, 1}, {1, 1, 4}, 1.0)), 3.0 * base, 1e-9);
  EXPECT_NEAR(volume(rod({0, 0, 0}, {0, 2, 0}, 1.0, 0.0)), 2.0 * base / 3.0, 1e-9);
}

TEST(Pieces, ATubeKeepsItsDistanceFromThePath) {
  const std::vector<Vec3> path = smooth({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}});
  const Mesh mesh = tube(path, 0.1, 6);
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::size_t k = 0; k <= 6; ++k) {
      EXPECT_NEAR((mesh.vertices[(i + 1) * 7 + k] - path[i]).norm(), 0.1, 1e-12);
    }
  }
}

TEST(Pieces, APlateLosesItsHole) {
  const std::vector<Vec2> square = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  EXPECT_NEAR(volume(plate(square, 0.5)), 2.0, 1e-12);
  EXPECT_NEAR(volume(plate(square, 0.5, 0.5)), 1.5, 1e-12);
}

TEST(Pieces, ASmoothCurveGoesThroughItsPoints) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 2, 0}, {3, 1, 1}};
  const std::vector<Vec3> curve = smooth(points);
  ASSERT_EQ(curve.size(), 17U);
  for (std::size_t k = 0; k < 3; ++k) {
    expect_vec(curve[8 * k], points[k]);
  }
}

TEST(Pieces, RepeatedPiecesStandEvenly) {
  const Mesh one = box({2, 0, 0}, {1, 1, 1});
  const Mesh all = around(one, 4);
  EXPECT_EQ(all.triangles.size(), 4 * one.triangles.size());
  const std::size_t n = one.vertices.size();
  expect_vec(all.vertices[n], {-one.vertices[0].y(), one.vertices[0].x(), one.vertices[0].z()});
  const Mesh pair = mirrored(one);
  expect_vec(pair.vertices[n], {-one.vertices[0].x(), one.vertices[0].y(), one.vertices[0].z()});
  EXPECT_EQ(pair.triangles.back()[0], one.triangles.back()[0] + n);
}

TEST(Pieces, RandomNumbersStayInTheirRange) {
  Random random(1);
  bool low = false;
  bool high = false;
  for (int k = 0; k < 1000; ++k) {
    const int n = whole(random, 3, 5);
    ASSERT_TRUE(n >= 3 && n <= 5);
    low = low || n == 3;
    high = high || n == 5;
    EXPECT_NEAR(direction(random).norm(), 1.0, 1e-12);
  }
  EXPECT_TRUE(low && high);
  EXPECT_FALSE(chance(random, 0.0));
  EXPECT_TRUE(chance(random, 1.0));
}

}  // namespace
}  // namespace spincat::background
