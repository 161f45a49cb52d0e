#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/reading.h"

namespace spincat {
namespace {

using test::problem_with;
using test::read_cloud;
using test::read_mesh;

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::vector<Vec3> kSquareVertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kSquareTriangles{{0, 1, 2}, {0, 2, 3}};

void expect_square(const std::string& text) {
  const Mesh mesh = read_mesh("square.obj", text);
  EXPECT_EQ(mesh.vertices, kSquareVertices) << text;
  EXPECT_EQ(mesh.triangles, kSquareTriangles) << text;
}

TEST(Obj, ReadsEveryFormOfACorner) {
  expect_square(kCorners + "f 1 2 3 4\n");
  expect_square(kCorners + "f 1/1 2/2 3/3 4/4\n");
  expect_square(kCorners + "f 1//1 2//1 3//1 4//1\n");
  expect_square(kCorners + "f 1/1/1 2/2/1 3/3/1 4/4/1");
  expect_square(kCorners + "f 1/ 2/ +3/ 4/");
}

TEST(Obj, CountsNegativeIndicesFromTheNewestVertex) {
  expect_square(kCorners + "f -4 -3 -2 -1\n");
  expect_square(kCorners + "f -4/-4/-1 -3 -2//-1 -1\n");
  expect_square("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf 1 3 4\n");
}

TEST(Obj, TakesAFaceBeforeItsVertices) {
  expect_square("f 1 2 3 4\n" + kCorners);
}

TEST(Obj, JoinsContinuedLines) {
  expect_square(kCorners + "f 1 2 \\\n3 4\n");
  expect_square(kCorners + "f 1 2\\\r\n 3 \\ \n 4\n");
  expect_square("v 0 0 0\nv 1 \\\n0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
}

TEST(Obj, CountsContinuedLines) {
  EXPECT_EQ(problem_with("a.obj", "v 0 \\\n0 0\nf 1 1 x\n"), "line 3: expected a vertex index, found 'x'");
}

TEST(Obj, DoesNotJoinWhatIsNoVertexOrFace) {
  expect_square("mtllib C:\\things\\\n" + kCorners + "# a comment \\\nf 1 2 3 4\n");
}

TEST(Obj, PassesOverTheRest) {
  expect_square("# comment\nmtllib a.mtl\no thing\n" + kCorners +
                "vt 0 0\nvn 0 0 1\ng a b\nusemtl red\ns off\nl 1 2 3\np 1 2\nvp 0 0\ncurv 0 1 1 2\n\xff\xfe\n"
                "f 1 2 3 4 # last\nend\n");
}

TEST(Obj, TakesColoursWeightsAndTrailingComments) {
  expect_square("v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1 1 0 0# red\nv 0 1 0 nan\nf 1 2 3 4#\n");
}

TEST(Obj, ReadsEveryWayToWriteANumber) {
  EXPECT_EQ(read_cloud("a.obj", "v .5 5. 1e-3\nv +1 -1E2 -0.\n").points,
            (std::vector<Vec3>{{0.5, 5, 0.001}, {1, -100, 0}}));
}

TEST(Obj, TakesEveryLineEnd) {
  expect_square("v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n");
  expect_square("v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4");
  expect_square("\xEF\xBB\xBFv 0 0 0\n\tv\t1\t0\t0\nv 1 1 0 \nv  0 1  0\n f 1 2 3 4");
}

TEST(Obj, CutsPolygonsOfHundredsOfSides) {
  std::string text = kCorners + "f";
  for (int i = 0; i < 700; ++i) {
    text += " " + std::to_string(i % 4 + 1) + "//1";
  }
  EXPECT_EQ(read_mesh("a.obj", text).triangles.size(), 698U);
}

TEST(Obj, IsAPointCloudWithoutFaces) {
  EXPECT_EQ(read_cloud("a.obj", kCorners).points, kSquareVertices);
  EXPECT_EQ(read_cloud("a.obj", kCorners + "l 1 2\nf 1 2\nf 1\nf\n").points, kSquareVertices);
  EXPECT_EQ(read_cloud("a.obj", "vn 0 0 1\nv 0 0 0\nvn 1 0 0\nv 1 2 3\n").normals,
            (std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_TRUE(read_cloud("a.obj", "vn 0 0 1\nv 0 0 0\nv 1 2 3\n").normals.empty());
}

TEST(Obj, KeepsVerticesThatAreNotFiniteOutOfTheWay) {
  expect_square("v nan nan nan\nv 0 0 0\nv 1 0 0\nv inf 0 0\nv 1 1 0\nv 0 1 0\nv 0 -inf 0\nf 2 3 5 6\n");
  expect_square("v 0 0 0\nv 1 0 0\nv nan 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 -2 5\n");
  EXPECT_EQ(problem_with("a.obj", "v nan 0 0\nv 0 0 0\nv 1 nan 0\nv 1 1 0\nf 2 3 4\n"),
            "line 3: a coordinate is not finite");
  EXPECT_EQ(problem_with("a.obj", "f 1 2 3\nv 0 0 0\nv 1 nan 0\nv 1 1 0\n"), "line 3: a coordinate is not finite");
  EXPECT_EQ(read_cloud("a.obj", "v 0 0 0\nvn 1 0 0\nv nan 0 0\nvn 0 1 0\nv 1 2 3\nvn 0 0 1\n").normals,
            (std::vector<Vec3>{{1, 0, 0}, {0, 0, 1}}));
}

TEST(Obj, NoticesAnEndWithinAFace) {
  expect_square(kCorners + "f 1/1/1 2/1/1 3/1/1 4/1/1");
  for (const std::string cut : {"1/1/1 2/1/1 3/1/1 4/1/", "1/1/1 2/1/1 3/1/1 4/1", "1/1/1 2/1/1 3/1/1 4",
                                "1//1 2//1 3//", "1/1/1 2/1/1", "1", ""}) {
    EXPECT_EQ(problem_with("a.obj", kCorners + "f " + cut), "line 5: the file ends within a face") << cut;
    EXPECT_NO_THROW(test::read_bytes("a.obj", kCorners + "f " + cut + "\n")) << cut;
  }
}

TEST(Obj, RefusesInWords) {
  EXPECT_EQ(problem_with("a.obj", ""), "is empty");
  EXPECT_EQ(problem_with("a.obj", "o nothing\n"), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.obj", kCorners + "f 1 2 3\nf 1 2 9\nf 1 2 5\nf 3 2 1\n"),
            "line 6: vertex index 9 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.obj", kCorners + "f 1 0 3\n"), "line 5: vertex index 0 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.obj", kCorners + "f 1 2 -5\n"), "line 5: vertex index -5 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.obj", kCorners + "f 1 2 4294967297\n"),
            "line 5: vertex index 4294967297 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.obj", kCorners + "f 1 2 3.0\n"), "line 5: expected a vertex index, found '3.0'");
  EXPECT_EQ(problem_with("a.obj", kCorners + "f 1 2 99999999999999999999\n"),
            "line 5: expected a vertex index, found '99999999999999999999'");
  EXPECT_EQ(problem_with("a.obj", "v 0 0\nv 1 1 1\n"), "line 1: expected a coordinate, but the line ends here");
  EXPECT_EQ(problem_with("a.obj", "\nv 0 0 nan\n"), "holds only points without finite coordinates");
  EXPECT_EQ(problem_with("a.obj", "v 0 0 1e400\n"), "line 1: '1e400' is too large for a number");
  EXPECT_EQ(problem_with("a.obj", "f 1 2 3\n"), "line 1: vertex index 3 is out of range (0 vertices)");
}

TEST(Obj, KeepsToTheLimits) {
  const std::string text = kCorners + "f 1 2 3 4\n";
  EXPECT_EQ(problem_with("a.obj", text, {.max_points = 3}), "holds more than 3 points; --max-points raises this limit");
  EXPECT_EQ(problem_with("a.obj", text, {.max_triangles = 1}),
            "holds more than 1 triangles; --max-triangles raises this limit");
  test::expect_sound(test::read_bytes("a.obj", text, {.max_points = 4, .max_triangles = 2}));
}

TEST(Obj, SurvivesDamage) {
  test::expect_survives_damage(
      "a.obj", "v 0 0 0 .5 .5 1\nv 1 0 0 # x\r\nv 1 1e0 0\nvn 0 0 1\nv 0 +1 0\nl 1 2\nf 1 2//1 \\\n-2/1/1 4\n");
}

}  // namespace
}  // namespace spincat
