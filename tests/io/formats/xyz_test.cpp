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

TEST(Xyz, JoinsScansThatEachHaveACount) {
  expect_two_points("1\n0 0 0\n1\n1 2 3\n");
  expect_two_points("1\n0 0 0 100 1 2 3\n\n0\n1\n1 2 3 100 1 2 3\n");
  EXPECT_EQ(problem_with("a.pts", "1\n0 0 0\n2\n1 2 3\n"), "line 5: the file ends after 1 of 2 points");
  EXPECT_EQ(problem_with("a.pts", "2\n0 0 0\n1\n1 2 3\n"), "line 3: expected a coordinate, but the line ends here");
}

TEST(Xyz, RefusesMorePointsThanAnnounced) {
  EXPECT_EQ(problem_with("a.pts", "1\n0 0 0\n1 2 3\n"), "line 3: more than the 1 points that line 1 announces");
  EXPECT_EQ(problem_with("a.pts", "# none\n0\n1 2 3\n"), "line 3: more than the 0 points that line 2 announces");
  EXPECT_EQ(problem_with("a.pts", "1\n0 0 0\n1\n1 2 3\n4 5 6\n"),
            "line 5: more than the 1 points that line 3 announces");
  expect_two_points("2\n0 0 0\n1 2 3\n\n# the end\n");
  expect_two_points(std::string("2\n0 0 0\n1 2 3\n\x1A\0\0\n", 18));
}

TEST(Xyz, RefusesARowWithAValueTooManyOrTooFew) {
  EXPECT_EQ(problem_with("a.xyz", "0 0 0\n7 1 2 3\n"), "line 2: one value more than in line 1");
  EXPECT_EQ(problem_with("a.xyz", "7 0 0 0\n1 2 3\n"), "line 2: one value less than in line 1");
  EXPECT_EQ(problem_with("a.pts", "2\n0 0 0 9 1 1 1\n1 2 9 1 1 1\n"), "line 3: one value less than in line 2");
  EXPECT_EQ(problem_with("a.txt", "0,0,0,9,1\n\n7,1,2,3,9,1 # x\n"), "line 3: one value more than in line 1");
  EXPECT_EQ(problem_with("a.txt", "0,5 0 0\n7 1,5 2 3\n"), "line 2: one value more than in line 1");
  expect_two_points("0 0 0 hard scape\n1 2 3 tree\n");
  expect_two_points("0,0,0,,9\n1,2,3,8,9 # 7,7\n");
}

TEST(Xyz, TakesANameForEachColumn) {
  expect_two_points("X Y Z R G B\n0 0 0 1 0 0\n1 2 3 0 1 0\n");  // colours of unit length
  expect_two_points("//X,Y,Z\n0,0,0\n1,2,3\n");
  expect_two_points("# x y z\n0 0 0\n1 2 3\n");
  expect_two_points("\"x\";\"y\";\"z\"\n0;0;0\n1;2;3\n");
  expect_two_points("X[m]\tY[m]\tZ[m]\n0\t0\t0\n1\t2\t3\n");
  expect_two_points("x (m) y (m) z (m)\n0 0 0\n1 2 3\n");
  expect_two_points("\"r\",\"Points:0\",\"Points:1\",\"Points:2\"\n9,0,0,0\n9,1,2,3\n");
  expect_two_points("2\nx y z\n0 0 0\n1 2 3\n");
  expect_two_points("x y z\n2\n0 0 0\n1 2 3\n");
  expect_two_points("x y z label\n0 0 0 wall\n1 2 3 floor\n");
}

TEST(Xyz, GoesByTheNamesOfColumnsInAnyOrder) {
  expect_two_points("z,y,x\n0,0,0\n3,2,1\n");
  expect_two_points("id label X Y Z\n7 wall 0 0 0\n8 floor 1 2 3\n");
  expect_two_points("# intensity x y z\n17 0 0 0\n18 1 2 3\n");
  expect_two_points("//R G B X Y Z\n1 0 0 0 0 0\n0 1 0 1 2 3\n");
  const PointCloud cloud = read_cloud("a.txt", "NX,NY,NZ,r,X,Y,Z\n0,0,2,9,0,0,0\n0,1,0,9,1,2,3\n");
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 2}, {0, 1, 0}}));
  EXPECT_EQ(read_cloud("a.txt", "x y z normal_x normal_y normal_z\n0 0 0 1 0 0\n1 2 3 0 1 0\n").normals.size(), 2U);
}

TEST(Xyz, TakesNoCommentThatSpeaksOfAxesForNames) {
  expect_two_points("# z x y: the axes of the sensor\n0 0 0\n1 2 3\n");
  expect_two_points("# scale z y x by 2 3\n0 0 0 4 5 6\n1 2 3 4 5 6\n");
}

TEST(Xyz, RefusesRowsThatTheNamesDoNotFit) {
  EXPECT_EQ(problem_with("a.xyz", "z y x\n0 0 0\n1 2 3 4\n"), "line 3: 4 values, but line 1 names 3 columns");
  EXPECT_EQ(problem_with("a.xyz", "id x y z\n1 0 0 0\n1 2 3\n"), "line 3: 3 values, but line 1 names 4 columns");
  EXPECT_EQ(problem_with("a.xyz", "east north up\n0 0 0\n"), "line 1: expected a coordinate, found 'east'");
}

TEST(Xyz, ReadsDecimalCommas) {
  const std::vector<Vec3> points{{0.25, 0.5, -0.125}, {2, 1.5, 0.625}};
  for (const std::string text : {"0,25 0,5 -0,125\n2,0 1,5 0,625\n", "0,25;0,5;-0,125\n2;1,5;0,625\n",
                                 "0,25\t0,5\t-0,125\r\n2\t1,5\t6,25e-1\r\n", "2\n0,25 0,5 -0,125 17\n2 1,5 0,625 18\n",
                                 "X Y Z\n0,25 0,5 -0,125\n2 1,5 0,625 # 1.5\n"}) {
    EXPECT_EQ(read_cloud("a.xyz", text).points, points) << text;
  }
  expect_two_points("0 0 0,0\n1 2 3\n");
  EXPECT_EQ(read_cloud("a.xyz", "0 0 0 0,6 0,8 0\n1 2 3 0 1 0\n").normals,
            (std::vector<Vec3>{{0.6, 0.8, 0}, {0, 1, 0}}));
}

TEST(Xyz, RefusesCommasThatMayBeEither) {
  const std::string either = "a comma may part numbers or be a decimal mark here, found ";
  EXPECT_EQ(problem_with("a.xyz", "1,234.5 2,000.0 3,0\n"), "line 1: " + either + "'1,234.5 2,000.0 3,0'");
  EXPECT_EQ(problem_with("a.xyz", "0 0 0\n0,5, 1,25, 2,0\n"), "line 2: " + either + "'0,5, 1,25, 2,0'");
  EXPECT_EQ(problem_with("a.xyz", "1,2,3 4,5,6\n"), "line 1: " + either + "'1,2,3 4,5,6'");
  EXPECT_EQ(problem_with("a.xyz", "0.5 1 2\n0 0 0,5\n"),
            "line 2: the comma is a decimal mark in line 2 but not in line 1");
  EXPECT_EQ(problem_with("a.xyz", "0 0 0,5\n0 0 0\n1,2,3\n"),
            "line 3: the comma is a decimal mark in line 1 but not in line 3");
}

TEST(Xyz, KeepsCommasThatPartNumbers) {
  expect_two_points("0,0,0,255,0,0\n1,2,3,255,1,1\n");
  expect_two_points("0,0,0,\n1,2,3 \n");
  expect_two_points("0, 0, 0\n1 ,2 ,3\n");
  expect_two_points("0 0 0 255,0,0\n1 2 3 255,1,1\n");
  expect_two_points("0.0,-0,0 # 1,5\n1.0,2.0,3\n");
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
  test::expect_survives_damage("a.pts", "2\n0 0.5 0, 0 0 1\n1 2e0 3; 0 1 0 # x\r\n");
  test::expect_survives_damage("a.pts", "//X Y Z\n1\n0 0,5 0\n1\n1 2 3\n");
  test::expect_survives_damage("a.txt", "z,nx,ny,nz,x,y\n0,0,0,1,2,3\n");
}

}  // namespace
}  // namespace spincat
