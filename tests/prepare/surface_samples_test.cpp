#include "spincat/prepare/surface_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/shapes.h"

namespace spincat {
namespace {

// The side of a box that a point of its surface lies on, as in test::box; the coordinate that is at its limit tells.
std::size_t side_of(const Vec3& p, const Vec3& half) {
  std::size_t side = 6;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(std::abs(p[axis]) - half[axis]) < 1e-12) {
      side = static_cast<std::size_t>(2 * axis + (p[axis] > 0.0 ? 1 : 0));
    }
  }
  return side;
}

TEST(SurfaceSamples, FallOnEachSideOfABoxByItsArea) {
  const Vec3 half(0.5, 1.0, 2.0);
  Random random(1);
  const SurfacePoints samples = surface_samples(test::box(1, 2, 4), 14'000, random);
  ASSERT_EQ(samples.positions.size(), 14'000U);
  ASSERT_EQ(samples.normals.size(), 14'000U);
  std::array<double, 7> found{};
  for (std::size_t i = 0; i < samples.positions.size(); ++i) {
    const std::size_t side = side_of(samples.positions[i], half);
    ++found[side];
    ASSERT_LT(side, 6U) << "not on the surface";
    EXPECT_EQ(samples.normals[i], test::box_normal(2 * side));
  }
  // Areas 8, 8, 4, 4, 2, 2 of 28.
  const std::array<double, 6> expected = {4000, 4000, 2000, 2000, 1000, 1000};
  double chi_square = 0.0;
  for (std::size_t side = 0; side < 6; ++side) {
    chi_square += (found[side] - expected[side]) * (found[side] - expected[side]) / expected[side];
  }
  EXPECT_LT(chi_square, 20.5);  // exceeded by one seed in a thousand (5 degrees of freedom)
}

TEST(SurfaceSamples, AreEvenWithinATriangle) {
  // The middle triangle of four equal ones, and the three at the corners.
  const Mesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  Random random(2);
  std::array<double, 4> found{};
  for (const Vec3& p : surface_samples(mesh, 4000, random).positions) {
    EXPECT_GE(p.x(), 0.0);
    EXPECT_GE(p.y(), 0.0);
    EXPECT_LE(p.x() + p.y(), 2.0 + 1e-12);
    ++found[p.x() > 1.0 ? 0 : p.y() > 1.0 ? 1 : p.x() + p.y() < 1.0 ? 2 : 3];
  }
  double chi_square = 0.0;
  for (const double count : found) {
    chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  }
  EXPECT_LT(chi_square, 16.3);  // one seed in a thousand (3 degrees of freedom)
}

TEST(SurfaceSamples, NeverComeFromAFaceWithoutArea) {
  // Faces without area first, between and last; the one with area lies in the plane z = 1.
  const Mesh mesh{{{0, 0, 0}, {5, 0, 0}, {9, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                  {{0, 1, 2}, {0, 0, 0}, {3, 4, 5}, {1, 1, 2}, {3, 5, 4}, {2, 1, 0}}};
  Random random(3);
  for (const Vec3& p : surface_samples(mesh, 5000, random).positions) {
    EXPECT_DOUBLE_EQ(p.z(), 1.0);
  }
}

TEST(SurfaceSamples, AreRepeatable) {
  Random a(4);
  Random b(4);
  const Mesh mesh = test::icosphere(1);
  const SurfacePoints first = surface_samples(mesh, 100, a);
  const SurfacePoints second = surface_samples(mesh, 100, b);
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.normals, second.normals);
}

TEST(HasArea, AsksForOneTriangle) {
  EXPECT_TRUE(has_area(test::box()));
  EXPECT_FALSE(has_area({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}}));
  EXPECT_FALSE(has_area({}));
}

}  // namespace
}  // namespace spincat
