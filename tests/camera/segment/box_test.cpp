#include "spincat/camera/segment/box.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "spincat/camera/segment/hull.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

using Eigen::Vector3f;

// Points all over a block that is turned by `angle` on a tilted plane and starts `low` metres over it.
struct Block {
  SupportPlane plane;
  Vector3f along;
  Vector3f across;
  Vector3f centre;
  std::vector<Vector3f> points;

  Block(float angle, const Vector3f& size, float low) {
    plane.normal = Vector3f(0.1F, -0.8F, -0.6F).normalized();
    plane.offset = 0.9F;
    const Vector3f x = plane.normal.unitOrthogonal();
    along = std::cos(angle) * x + std::sin(angle) * plane.normal.cross(x);
    across = plane.normal.cross(along);
    centre = (0.5F * size.z() + low - plane.offset) * plane.normal + 0.2F * along + 0.1F * across;
    Random random(1);
    for (int i = 0; i < 20'000; ++i) {
      const auto within = [&](float extent) { return static_cast<float>(random.uniform(-0.5, 0.5)) * extent; };
      points.push_back(centre + within(size.x()) * along + within(size.y()) * across + within(size.z()) * plane.normal);
    }
  }
};

TEST(BoxOnPlane, IsThatOfATurnedBlock) {
  for (const float angle : {0.0F, 0.3F, 1.1F, 2.5F}) {
    const Block block(angle, {0.2F, 0.1F, 0.15F}, 0.0F);
    const OrientedBox box = box_on_plane(block.points, block.plane, 0.004F, 0.01F);
    EXPECT_LT((box.size - Vector3f(0.2F, 0.1F, 0.15F)).norm(), 0.004F);
    EXPECT_LT((box.centre - block.centre).norm(), 0.003F);
    EXPECT_GT(std::abs(box.axes.col(0).dot(block.along)), 0.999F);
    EXPECT_LT((box.axes.col(2) - block.plane.normal).norm(), 1e-5F);
    EXPECT_NEAR(box.axes.determinant(), 1.0F, 1e-4F);
  }
}

TEST(BoxOnPlane, StartsWhereTheThingIsSeenToStart) {
  const Block block(0.4F, {0.2F, 0.1F, 0.1F}, 0.2F);  // on another thing
  const OrientedBox box = box_on_plane(block.points, block.plane, 0.004F, 0.02F);
  EXPECT_NEAR(box.size.z(), 0.1F, 0.002F);
  EXPECT_NEAR(block.plane.height(box.centre), 0.25F, 0.002F);
}

TEST(BoxOnPlane, PassesOverPointsThatAreAlmostAlone) {
  Block block(0.4F, {0.2F, 0.1F, 0.1F}, 0.0F);
  for (int k = 0; k < 10; ++k) {
    block.points.push_back(block.centre + (0.2F + 0.03F * static_cast<float>(k)) * block.across);
  }
  EXPECT_NEAR(box_on_plane(block.points, block.plane, 0.004F, 0.01F).size.y(), 0.1F, 0.002F);
}

TEST(BoxOnPlane, IsMadeOfFewPoints) {
  const SupportPlane plane{-Vector3f::UnitZ(), 1.0F};
  const std::vector<Vector3f> one = {{0.1F, 0.2F, 0.9F}};
  const OrientedBox box = box_on_plane(one, plane, 0.004F, 0.01F);
  EXPECT_LT((box.centre - one[0]).norm(), 1e-3F);
  EXPECT_LT(box.size.norm(), 1e-3F);
  EXPECT_TRUE(box.axes.allFinite());
}

TEST(ConvexHull, HasTheCornersAlone) {
  const std::vector<GridPoint> hull = convex_hull({{0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {1, 1}, {2, 1}});
  EXPECT_EQ(hull, (std::vector<GridPoint>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_TRUE(is_inside(hull, {1, 1}));
  EXPECT_TRUE(is_inside(hull, {2, 1}));
  EXPECT_FALSE(is_inside(hull, {3, 1}));
  EXPECT_EQ(convex_hull({{5, 5}}), (std::vector<GridPoint>{{5, 5}}));
}

}  // namespace
}  // namespace spincat
