#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/reading.h"

namespace spincat {
namespace {

using test::problem_with;
using test::read_cloud;
using test::read_mesh;

const std::string kSquareBody = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::vector<Vec3> kSquareVertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kSquareTriangles{{0, 1, 2}, {0, 2, 3}};

void expect_square(const std::string& text) {
  const Mesh mesh = read_mesh("square.off", text);
  EXPECT_EQ(mesh.vertices, kSquareVertices) << text;
  EXPECT_EQ(mesh.triangles, kSquareTriangles) << text;
}

TEST(Off, ReadsAPolygonAsAFan) {
  expect_square("OFF\n4 1 4\n" + kSquareBody);
}

TEST(Off, TakesEveryHeaderInUse) {
  expect_square("OFF 4 1 4\n" + kSquareBody);
  expect_square("OFF4 1 4\n" + kSquareBody);  // ModelNet
  expect_square("4 1 4\n" + kSquareBody);
  expect_square("OFF\n4 1\n" + kSquareBody);  // no number of edges
  expect_square("off\n4 1 4\n" + kSquareBody);
  expect_square("\xEF\xBB\xBFOFF\n4 1 4\n" + kSquareBody);
}

TEST(Off, TakesCommentsAndBlankLinesAnywhere) {
  expect_square(
      "# made by hand\n\nOFF # the header\n#\n4 1 4 # counts\n\n0 0 0 # first\n1 0 0\n # more\n1 1 0\n0 1 0\n\n"
      "4 0 1 2 3# glued\n# end");
}

TEST(Off, TakesEveryLineEnd) {
  expect_square("OFF\r\n4 1 4\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3\r\n");
  expect_square("OFF\r4 1 4\r0 0 0\r1 0 0\r1 1 0\r0 1 0\r4 0 1 2 3");
  expect_square("OFF\n4 1 4\n0\t0  0 \n1 0 0\n1 1 0\n0 1 0\n4 0 1\n2 3");
}

TEST(Off, PassesOverColoursNormalsAndTextures) {
  expect_square("OFF\n4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
  expect_square("OFF\n4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5 1.0\n");
  expect_square("COFF\n4 1 4\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n4 0 1 2 3\n");
  expect_square("NOFF\n4 1 4\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n");
  expect_square("CNOFF\n4 1 4\n0 0 0 0 0 1 9 9 9\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n");
  expect_square("STOFF\n4 1 4\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n");
  expect_square("STCNOFF 4 1 4\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n");
}

TEST(Off, ReadsEveryWayToWriteANumber) {
  const PointCloud cloud = read_cloud("a.off", "OFF 2 0 0\n.5 5. +1\n1e-3 -1E+2 1e-999\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{0.5, 5, 1}, {0.001, -100, 0}}));
}

TEST(Off, IsAPointCloudWithoutFaces) {
  const PointCloud plain = read_cloud("a.off", "OFF\n2 0 0\n0 0 0\n1 2 3\n");
  EXPECT_EQ(plain.points, (std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}}));
  EXPECT_TRUE(plain.normals.empty());
  EXPECT_FALSE(plain.sensor);
  EXPECT_EQ(read_cloud("a.off", "NOFF\n2 0 0\n0 0 0 1 0 0\n1 2 3 0 0 1\n").normals,
            (std::vector<Vec3>{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(read_cloud("a.off", "OFF\n2 2 0\n0 0 0\n1 2 3\n2 0 1\n1 0").points.size(), 2U);  // an edge, a point
}

TEST(Off, KeepsRepeatedAndFlatFaces) {
  EXPECT_EQ(read_mesh("a.off", "OFF\n2 2 0\n0 0 0\n1 0 0\n3 0 1 1\n3 0 1 1\n").triangles,
            (std::vector<Triangle>{{0, 1, 1}, {0, 1, 1}}));
}

TEST(Off, CutsPolygonsOfAThousandSides) {
  std::string text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000";
  for (int i = 0; i < 1000; ++i) {
    text += " " + std::to_string(i % 3);
  }
  EXPECT_EQ(read_mesh("a.off", text).triangles.size(), 998U);
}

TEST(Off, RefusesInWords) {
  EXPECT_EQ(problem_with("a.off", ""), "is empty");
  EXPECT_EQ(problem_with("a.off", "# nothing\n"), "line 2: expected the header 'OFF', but the file ends here");
  EXPECT_EQ(problem_with("a.off", "ply\n"), "line 1: expected the header 'OFF', found 'ply'");
  EXPECT_EQ(problem_with("a.off", "4OFF\n1 0 0\n"),
            "line 1: is a 4OFF file, whose vertices do not have three coordinates; spincat reads only those that do");
  EXPECT_EQ(problem_with("a.off", "nOFF 5\n1 0 0\n"),
            "line 1: is a nOFF file, whose vertices do not have three coordinates; spincat reads only those that do");
  EXPECT_EQ(problem_with("a.off", "OFF BINARY\n"), "line 1: is a binary OFF file; spincat reads only the text form");
  EXPECT_EQ(problem_with("a.off", "OFF\n0 0 0\n"), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.off", "OFF\nx 1\n"), "line 2: expected the number of vertices, found 'x'");
  EXPECT_EQ(problem_with("a.off", "OFF\n-1 1\n"), "line 2: expected the number of vertices, found '-1'");
}

TEST(Off, NamesTheLineOfABadNumber) {
  const std::string head = "OFF\n1 0 0\n";
  EXPECT_EQ(problem_with("a.off", head + "0 0 nan\n"), "line 3: a coordinate must be finite, found 'nan'");
  EXPECT_EQ(problem_with("a.off", head + "0 -inf 0\n"), "line 3: a coordinate must be finite, found '-inf'");
  EXPECT_EQ(problem_with("a.off", head + "0 1e999 0\n"), "line 3: '1e999' is too large for a number");
  EXPECT_EQ(problem_with("a.off", head + "0 0x10 0\n"), "line 3: expected a coordinate, found '0x10'");
  EXPECT_EQ(problem_with("a.off", head + "0 +-1 0\n"), "line 3: expected a coordinate, found '+-1'");
  EXPECT_EQ(problem_with("a.off", head + "0 0,5 0\n"), "line 3: expected a coordinate, found '0,5'");
}

TEST(Off, ChecksIndicesAndCounts) {
  EXPECT_EQ(problem_with("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            "line 6: vertex index 3 is out of range (3 vertices)");
  EXPECT_EQ(problem_with("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"),
            "line 6: vertex index -1 is out of range (3 vertices)");
  EXPECT_EQ(problem_with("a.off", "OFF\n99999999999 1 0\n0 0 0\n"),
            "line 2: announces 99999999999 vertices, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.off", "OFF\n1 50 0\n0 0 0\n"),
            "line 2: announces 50 faces, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0                       \n"),
            "line 5: expected a coordinate, but the file ends here");
  EXPECT_EQ(problem_with("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9999999999 0 1 2\n"),
            "line 7: expected a vertex index, but the file ends here");
}

TEST(Off, KeepsToTheLimits) {
  const std::string text = "OFF\n4 1 4\n" + kSquareBody;
  EXPECT_EQ(problem_with("a.off", text, {.max_points = 3}), "holds more than 3 points; --max-points raises this limit");
  EXPECT_EQ(problem_with("a.off", text, {.max_triangles = 1}),
            "holds more than 1 triangles; --max-triangles raises this limit");
  test::expect_sound(test::read_bytes("a.off", text, {.max_points = 4, .max_triangles = 2}));
}

TEST(Off, SurvivesDamage) {
  test::expect_survives_damage("a.off", "COFF\n4 1 4\n0 0 0\n1 0 0 # x\r\n1 1 0 .5 .5 1\n0 1e0 0\n4 0 1 2 3 255 0 0\n");
}

}  // namespace
}  // namespace spincat
