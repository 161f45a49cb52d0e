#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/reading.h"

namespace spincat {
namespace {

using test::problem_with;
using test::read_cloud;

const std::vector<Vec3> kTwoPoints{{0, 0, 0}, {1, 2, 3}};

void expect_two_points(const std::string& text) {
  const PointCloud cloud = read_cloud("a.xyz", text);
  EXPECT_EQ(cloud.points, kTwoPoints) << text;
  EXPECT_TRUE(cloud.normals.empty()) << text;
}

TEST(Xyz, ReadsThreeColumns) {
  expect_two_points("0 0 0\n1 2 3\n");
  expect_two_points("0\t0\t0\r\n+1\t2.\t3e0");
  expect_two_points("0,0,0\n1, 2, 3\n");
  expect_two_points("0;0;0\n1; 2; 3;\n");
}

TEST(Xyz, GoesByAnyOfItsNames) {
  for (const char* name : {"a.xyz", "a.xyzn", "a.pts", "a.asc", "a.txt", "A.TXT"}) {
    EXPECT_EQ(read_cloud(name, "0 0 0\n1 2 3\n").points, kTwoPoints) << name;
  }
}

TEST(Xyz, TakesCommentsAndBlankLines) {
  expect_two_points("# a scan\n\n// x y z\n0 0 0 # first\n\n1 2 3// second\n//");
}

TEST(Xyz, SkipsALoneCount) {
  expect_two_points("2\n0 0 0\n1 2 3\n");
  expect_two_points("# points\n2 \n0 0 0\n1 2 3\n");
  EXPECT_EQ(problem_with("a.pts", "3\n0 0 0\n1 2 3\n"), "line 4: the file ends after 2 of 3 points");
}

TEST(Xyz, TakesSixColumnsOfUnitLengthAsNormals) {
  const PointCloud cloud = read_cloud("a.xyzn", "0 0 0 1 0 0\n1 2 3 0 0.6 -0.805\n");
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{1, 0, 0}, {0, 0.6, -0.805}}));
}

TEST(Xyz, KeepsNormalsThatAreNotKnown) {
  const PointCloud cloud = read_cloud("a.xyzn", "0 0 0 0 0 0\n1 2 3 0 1 0\n");
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(read_cloud("a.xyzn", "0 0 0 nan nan nan\n1 2 3 0 1 0\n").normals.size(), 2U);
}

TEST(Xyz, TakesOtherColumnsAsSomethingElse) {
  expect_two_points("0 0 0 255 128 0\n1 2 3 0 0 0\n");
  expect_two_points("0 0 0 1 0 0\n1 2 3 0.5 0.5 0.5\n");
  expect_two_points("0 0 0 0 0 0\n1 2 3 0 0 0\n");
  expect_two_points("0 0 0 17\n1 2 3 18\n");
  expect_two_points("0 0 0 1 0 0\n1 2 3\n");
  expect_two_points("0 0 0 17 255 255 255\n1 2 3 18 0 0 0\n");
  expect_two_points("0 0 0 wall\n1 2 3 floor\n");
}

TEST(Xyz, LeavesOutWhatWasNotMeasured) {
  expect_two_points("nan nan nan\n0 0 0\n1 2 3\n1 2 inf\n");
  EXPECT_EQ(read_cloud("a.xyz", "nan 0 0 0 0 1\n1 2 3 0 1 0\n").normals, (std::vector<Vec3>{{0, 1, 0}}));
  EXPECT_EQ(problem_with("a.xyz", "nan 0 0\n"), "holds only points without finite coordinates");
}

TEST(Xyz, RefusesInWords) {
  EXPECT_EQ(problem_with("a.xyz", ""), "is empty");
  EXPECT_EQ(problem_with("a.xyz", "# nothing\n"), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.xyz", "0 0\n"), "line 1: expected a coordinate, but the line ends here");
  EXPECT_EQ(problem_with("a.txt", "Notes about the chairs\n"), "line 1: expected a coordinate, found 'Notes'");
  EXPECT_EQ(problem_with("a.txt", "Notes\n"),
            "line 1: expected the number of points or three coordinates, found 'Notes'");
  EXPECT_EQ(problem_with("a.xyz", "0 0 0\n\n1 x 0\n"), "line 3: expected a coordinate, found 'x'");
  EXPECT_EQ(problem_with("a.xyz", "0 0 0\n7\n"), "line 2: expected a coordinate, but the line ends here");
}

TEST(Xyz, KeepsToTheLimits) {
  EXPECT_EQ(problem_with("a.xyz", "0 0 0\n1 1 1\n", {.max_points = 1}),
            "holds more than 1 points; --max-points raises this limit");
}

TEST(Xyz, SurvivesDamage) {
  test::expect_survives_damage("a.pts", "2\n0 0.5 0,0 0 1\n1 2e0 3; 0 1 0 # x\r\n");
}

}  // namespace
}  // namespace spincat
