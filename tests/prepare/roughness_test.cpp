#include "spincat/prepare/roughness.h"

#include <gtest/gtest.h>

#include "spincat/geometry/random.h"
#include "support/shapes.h"

namespace spincat {
namespace {

Mesh rough(Mesh mesh, double noise) {
  Random random(1);
  for (Vec3& v : mesh.vertices) {
    v += noise * Vec3(random.normal(), random.normal(), random.normal());
  }
  return mesh;
}

TEST(MedianFold, IsTheAngleBetweenFacesThatShareAnEdge) {
  const Mesh roof{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}}, {{0, 2, 1}, {0, 1, 3}}};  // folded by 45 degrees
  EXPECT_NEAR(median_fold(roof), 45.0, 1e-9);
}

TEST(MedianFold, IsSmallWhereASurfaceIsSmooth) {
  EXPECT_LT(median_fold(test::icosphere(3)), 10.0);
  EXPECT_GT(median_fold(rough(test::icosphere(3), 0.05)), 25.0);
}

TEST(MedianFold, DoesNotSeeWhichWayFacesLook) {
  const Mesh mesh = rough(test::icosphere(2), 0.03);
  EXPECT_NEAR(median_fold(test::half_flipped(mesh)), median_fold(mesh), 1e-9);
}

TEST(MedianFold, TakesVerticesAtOnePositionAsOne) {
  const Mesh mesh = rough(test::icosphere(2), 0.03);
  EXPECT_NEAR(median_fold(test::soup_of(mesh)), median_fold(mesh), 1e-9);
}

TEST(MedianFold, IsNothingWithoutSharedEdgesOrArea) {
  EXPECT_EQ(median_fold({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), 0.0);
  EXPECT_EQ(median_fold({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 0, 3}}}), 0.0);
  EXPECT_EQ(median_fold({}), 0.0);
}

TEST(MedianFold, OfManyFacesIsNearlyThatOfAll) {
  // 81,920 faces: a fifth of the edges is looked at. Noise in proportion to the edges folds both alike.
  const double of_all = median_fold(rough(test::icosphere(4), 0.01));
  EXPECT_NEAR(median_fold(rough(test::icosphere(6), 0.0025)), of_all, 3.0);
}

}  // namespace
}  // namespace spincat
