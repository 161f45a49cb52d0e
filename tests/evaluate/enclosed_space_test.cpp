#include "spincat/evaluate/enclosed_space.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace spincat {
namespace {

TEST(EnclosedSpace, OfABallIsWhatIsInside) {
  const EnclosedSpace space(test::scaled(test::icosphere(3), 0.9));
  for (const Vec3& direction : test::sphere_points(50)) {
    EXPECT_TRUE(space.contains(0.8 * direction));
    EXPECT_FALSE(space.contains(0.91 * direction));
    EXPECT_FALSE(space.contains(5.0 * direction));
  }
  EXPECT_TRUE(space.contains({0, 0, 0}));
}

TEST(EnclosedSpace, ABoxMustBeInsideAtEveryCorner) {
  const EnclosedSpace space(test::box(1.0, 1.0, 1.0));
  EXPECT_TRUE(space.contains({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}));
  EXPECT_FALSE(space.contains({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.6}));
  EXPECT_FALSE(space.contains({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
}

TEST(EnclosedSpace, WhatIsOpenToOneSideEnclosesNothingThere) {
  Mesh open = test::box(1.0, 1.0, 1.0);
  open.triangles.resize(10);
  EXPECT_FALSE(EnclosedSpace(open).contains({0, 0, 0}));
  EXPECT_FALSE(EnclosedSpace({}).contains({0, 0, 0}));
}

}  // namespace
}  // namespace spincat
