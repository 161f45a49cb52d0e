#include "spincat/prepare/lone_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "spincat/geometry/random.h"
#include "spincat/prepare/as_cloud.h"
#include "spincat/prepare/prepare.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using Indices = std::vector<std::uint32_t>;

// Points drawn at random from the surface of a box of 2 x 1 x 0.5.
std::vector<Vec3> surface(std::size_t points) {
  return as_cloud(test::box(2, 1, 0.5), points, 0.0, 7).points;
}

Vec3 somewhere_within(double radius, Random& random) {
  Vec3 p;
  do {
    p = {random.uniform(-radius, radius), random.uniform(-radius, radius), random.uniform(-radius, radius)};
  } while (p.norm() > radius);
  return p;
}

double distance_to_box(const Vec3& p) {
  const Vec3 outside = (p.cwiseAbs() - Vec3(1, 0.5, 0.25)).cwiseMax(0.0);
  const double inside = (Vec3(1, 0.5, 0.25) - p.cwiseAbs()).minCoeff();
  return inside > 0.0 ? inside : outside.norm();
}

TEST(LonePoints, AnEvenSampleHasNone) {
  for (const std::size_t points : {64U, 500U, 2'000U, 50'000U}) {
    EXPECT_EQ(lone_points(surface(points)), Indices()) << points;
  }
}

TEST(LonePoints, OneFarPointIsFoundAtAnyDistance) {
  for (const double distance : {3.0, 30.0, 1e6, 1e30, 1e200, 1e308}) {
    std::vector<Vec3> points = surface(2'000);
    points.insert(points.begin() + 5, Vec3(0, 0, distance));
    EXPECT_EQ(lone_points(points), Indices{5}) << distance;
  }
}

TEST(LonePoints, OneInTheHollowOfAnObjectIsFound) {
  std::vector<Vec3> points = surface(20'000);
  points.emplace_back(0, 0, 0);
  EXPECT_EQ(lone_points(points), Indices{20'000});
}

TEST(LonePoints, OneInAHundredWithinThreeRadiiAreFoundUnlessTheyLieAtTheSurface) {
  for (const std::size_t count : {2'000U, 50'000U}) {
    std::vector<Vec3> points = surface(count);
    Random random(3);
    for (std::size_t i = 0; i < count / 100; ++i) {
      points.push_back(somewhere_within(3 * std::sqrt(1.3125), random));
    }
    const Indices lone = lone_points(points);
    // What four points around a place on the surface reach, on average: 7 is the area.
    const double spacing = std::sqrt(4 * 7.0 / static_cast<double>(count) / 3.14);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (i < count) {
        EXPECT_FALSE(std::ranges::binary_search(lone, i)) << i;
      } else if (distance_to_box(points[i]) > 5 * spacing) {
        EXPECT_TRUE(std::ranges::binary_search(lone, i)) << i;
      }
    }
  }
}

TEST(LonePoints, AZeroBesideTheSurfaceIsFoundButNotOneOnIt) {
  std::vector<Vec3> points = surface(2'000);
  for (Vec3& p : points) {
    p += Vec3(0, 0, 0.25 + 0.12);  // the spacing is some 0.07
  }
  points.emplace_back(0, 0, 0);
  EXPECT_EQ(lone_points(points), Indices{2'000});
  std::vector<Vec3> grid;
  for (int i = 0; i < 100; ++i) {
    grid.emplace_back(i % 10, i / 10, 0);
  }
  EXPECT_EQ(lone_points(grid), Indices());
}

TEST(LonePoints, WhatIsThinlySampledStays) {
  // A plate of 5,000 points, and beside it a rod of 40 points in a row.
  std::vector<Vec3> points;
  Random random(11);
  for (int i = 0; i < 5'000; ++i) {
    points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), 0.0);
  }
  for (int i = 0; i < 40; ++i) {
    points.emplace_back(0.0, 0.0, 0.01 * (i + 1));
  }
  EXPECT_EQ(lone_points(points), Indices());
}

TEST(LonePoints, ACoarseHalfBesideADenseOneStays) {
  std::vector<Vec3> points;
  Random random(5);
  for (int i = 0; i < 8'000; ++i) {
    points.emplace_back(random.uniform(-1, 0), random.uniform(-1, 1), 0.0);
  }
  for (int i = 0; i < 800; ++i) {
    points.emplace_back(random.uniform(0, 1), random.uniform(-1, 1), 0.0);
  }
  EXPECT_EQ(lone_points(points), Indices());
}

TEST(LonePoints, FewPointsSayNothing) {
  std::vector<Vec3> points = surface(62);
  points.emplace_back(0, 0, 30);
  EXPECT_EQ(lone_points(points), Indices());
  EXPECT_EQ(lone_points({}), Indices());
}

TEST(LonePoints, NothingIsLeftOutWhereMoreThanATenthWouldBe) {
  std::vector<Vec3> points;
  for (int group = 0; group < 100; ++group) {  // pairs, each far from the others
    points.emplace_back(group * group, 0, 0);
    points.emplace_back(group * group, 1e-3, 0);
  }
  EXPECT_EQ(lone_points(points), Indices());
}

TEST(WithoutLonePoints, RepeatedZerosAreNothingMeasured) {
  const std::vector<Vec3> clean = surface(2'000);
  PointCloud cloud{clean, {}, Vec3(0, 0, 5)};
  cloud.normals.assign(clean.size(), Vec3(0, 0, 1));
  for (int i = 0; i < 400; ++i) {
    cloud.points.insert(cloud.points.begin() + 3, Vec3(0, -0.0, 0));
    cloud.normals.insert(cloud.normals.begin() + 3, Vec3(1, 0, 0));
  }
  const PointCloud result = without_lone_points(cloud);
  EXPECT_EQ(result.points, clean);
  EXPECT_EQ(result.normals, std::vector<Vec3>(clean.size(), Vec3(0, 0, 1)));
  EXPECT_EQ(result.sensor, cloud.sensor);
}

TEST(WithoutLonePoints, TellsWhichPointsOfTheFileWent) {
  std::vector<Vec3> points = surface(2'000);
  points.insert(points.begin() + 7, points[3]);
  points.insert(points.begin() + 100, Vec3(60, 0, 0));
  const PointCloud cloud{points, {}, {}, {0, 50}};  // a reader left out the first and the 51st point of the file
  EXPECT_EQ(without_lone_points(cloud).left_out, (Indices{0, 8, 50, 102}));
  EXPECT_EQ(without_lone_points({surface(2'000), {}, {}, {5}}).left_out, Indices{5});
}

TEST(WithoutLonePoints, ZerosStayWhereTheyAreAllThereIs) {
  EXPECT_EQ(without_lone_points({{{0, 0, 0}, {0, 0, 0}}, {}, {}}).points, (std::vector<Vec3>{{0, 0, 0}}));
}

TEST(WithoutLonePoints, AZeroOnTheSurfaceStays) {
  const PointCloud cloud{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {}, {}};
  EXPECT_EQ(without_lone_points(cloud).points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(WithoutLonePoints, AnObjectIsPreparedAsIfTheyWereNotThere) {
  PrepareSettings settings;
  for (const double factor : {1.0, 1e-6, 1e12}) {
    std::vector<Vec3> clean = surface(3'000);
    for (Vec3& p : clean) {
      p = factor * (p + Vec3(4, 5, 6));
    }
    const PreparedObject expected = prepare(PointCloud{clean, {}, {}}, settings, 1);
    std::vector<Vec3> dirty = clean;
    dirty.emplace_back(0, 0, 0);
    dirty.emplace_back(factor * Vec3(30, -20, 10));
    const PreparedObject prepared = prepare(PointCloud{dirty, {}, {}}, settings, 1);
    EXPECT_EQ(prepared.scale, expected.scale);
    EXPECT_EQ(prepared.centre, expected.centre);
    ASSERT_EQ(prepared.surface.size(), expected.surface.size());
    for (std::size_t i = 0; i < expected.surface.size(); ++i) {
      ASSERT_EQ(prepared.surface.position(i), expected.surface.position(i)) << i;
    }
  }
}

}  // namespace
}  // namespace spincat
