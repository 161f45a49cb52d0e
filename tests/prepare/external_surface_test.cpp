#include "spincat/prepare/external_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "prepare/seen_surface.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using test::seen_of;
using test::unit_box;

TEST(ExternalSurface, OfASphereLiesOnItsFacesAndPointsOut) {
  const SurfacePoints seen = seen_of(test::icosphere(4));  // 5,120 faces: between 0.998 and 1 from the centre
  EXPECT_GT(seen.positions.size(), 40'000U);               // of 20 x 4,096 pixels
  for (std::size_t i = 0; i < seen.positions.size(); ++i) {
    EXPECT_GT(seen.positions[i].norm(), 0.997);
    EXPECT_LT(seen.positions[i].norm(), 1.0 + 1e-12);
    EXPECT_NEAR(seen.normals[i].norm(), 1.0, 1e-12);
    EXPECT_GT(seen.normals[i].dot(seen.positions[i]), 0.99);
  }
}

TEST(ExternalSurface, SeesOnlyTheOutsideOfABoxWithInnerWallsAndFlippedFaces) {
  const Mesh inside = test::joined(test::scaled(unit_box(), 0.7), test::scaled(test::icosphere(1), 0.3));
  const Mesh mesh = test::half_flipped(test::joined(unit_box(), inside));
  const double wall = 1.0 / std::sqrt(3.0);
  const SurfacePoints seen = seen_of(mesh);
  ASSERT_GT(seen.positions.size(), 10'000U);
  std::array<int, 6> on_side{};
  for (std::size_t i = 0; i < seen.positions.size(); ++i) {
    const Vec3& p = seen.positions[i];
    const Vec3& n = seen.normals[i];
    Eigen::Index axis = 0;
    EXPECT_DOUBLE_EQ(n.cwiseAbs().maxCoeff(&axis), 1.0);
    EXPECT_NEAR(p[axis], n[axis] * wall, 1e-9) << "a normal points in, or a point is no outer one";
    EXPECT_LE(p.cwiseAbs().maxCoeff(), wall + 1e-9);
    ++on_side[static_cast<std::size_t>(2 * axis + (n[axis] > 0.0 ? 1 : 0))];
  }
  for (const int count : on_side) {
    EXPECT_GT(count, 1000);
  }
}

TEST(ExternalSurface, DoesNotDependOnHowFacesTurn) {
  const Mesh mesh = unit_box();
  const SurfacePoints a = seen_of(mesh);
  const SurfacePoints b = seen_of(test::half_flipped(mesh));
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    EXPECT_LE((a.positions[i] - b.positions[i]).norm(), 1e-12);
    EXPECT_LE((a.normals[i] - b.normals[i]).norm(), 1e-12);
  }
}

TEST(ExternalSurface, SeesBothSidesOfTwoTriangles) {
  const Mesh mesh{{{-0.7, -0.7, 0}, {0.7, -0.7, 0}, {0.7, 0.7, 0}, {-0.7, 0.7, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const SurfacePoints seen = seen_of(mesh);
  int up = 0;
  for (std::size_t i = 0; i < seen.positions.size(); ++i) {
    EXPECT_NEAR(seen.positions[i].z(), 0.0, 1e-12);
    EXPECT_EQ(std::abs(seen.normals[i].z()), 1.0);
    up += seen.normals[i].z() > 0.0 ? 1 : 0;
  }
  const auto all = static_cast<int>(seen.positions.size());
  EXPECT_GT(up, all / 3);
  EXPECT_LT(up, 2 * all / 3);
}

TEST(ExternalSurface, IsRepeatableAndTurnsWithTheSeed) {
  const Mesh mesh = test::icosphere(1);
  EXPECT_EQ(seen_of(mesh, 5).positions, seen_of(mesh, 5).positions);
  EXPECT_NE(seen_of(mesh, 5).positions, seen_of(mesh, 6).positions);
}

TEST(ExternalSurface, OfFacesWithoutAreaIsEmpty) {
  EXPECT_TRUE(seen_of({{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}}).positions.empty());
}

}  // namespace
}  // namespace spincat
