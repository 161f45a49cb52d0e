#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"

namespace spincat {
namespace {

using test::big;
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

TEST(Off, TakesAnyBlankBetweenNumbers) {
  expect_square("OFF\n4 1 0\n0 0 0 1 0 0 1 1 0 0 1 0\n4 0 1 2 3\n");
  expect_square("OFF\n4 1 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n4 0 1 2 3 255 0 0\n");
  expect_square("OFF 4 1 0 0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3");
  expect_square("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0 3 0 1 2 3 0 2 3\n");
  expect_square("OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 0.5 0.5 0.5\n3 0 2 3 1 1 1 1\n");
  expect_square("COFF 4 1 0 0 0 0 9 9 9 1 1 0 0 9 9 9 1 1 1 0 9 9 9 1 0 1 0 9 9 9 1 4 0 1 2 3");
  expect_square("STNOFF 4 1 0 0 0 0 0 0 1 .5 .5 1 0 0 0 0 1 .5 .5 1 1 0 0 0 1 .5 .5 0 1 0 0 0 1 .5 .5 4 0 1 2 3");
  expect_square("OFF\n4 1 0\n0 0\n0 1\n0 0\n1 1\n0 0\n1 0\n4 0 1 2 3\n");
  expect_square("OFF\n4 1 0\n0 0 0 1 0\n0 1 1 0 0\n1 0 4 0 1\n2 3\n");
  expect_square("OFF\n4\n1\n0\n0\n0\n0\n1\n0\n0\n1\n1\n0\n0\n1\n0\n4\n0\n1\n2\n3\n");
  EXPECT_EQ(read_cloud("a.off", "NOFF\n2 0 0\n0 0 0 1\n0 0\n1 2 3\n0 0 1").normals.size(), 2U);
  EXPECT_EQ(read_cloud("a.off", "NOFF 2 0 0 0 0 0 1 0 0 1 2 3 0 0 1").normals,
            (std::vector<Vec3>{{1, 0, 0}, {0, 0, 1}}));
}

TEST(Off, PassesOverColoursThatEachVertexHas) {
  expect_square("OFF\n4 2 4\n0 0 0 1 1 1\n1 0 0 1 1 1\n1 1 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2 3 1 1\n3 0 2 3 3 1 1\n");
  expect_square("OFF\n4 1 4\n0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n0 1 0 255 0 0\n4 0 1 2 3\n");
}

TEST(Off, RefusesARowWithANumberTooMany) {
  EXPECT_EQ(problem_with("a.off", "OFF\n4 1 4\n0 0 0\n1 0 0 7\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
            "line 4: 1 more values than a row should have, but 0 more in line 3");
  EXPECT_EQ(problem_with("a.off", "OFF\n4 1 4\n7 0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
            "line 4: 0 more values than a row should have, but 1 more in line 3");
}

TEST(Off, RefusesMoreRowsThanAnnounced) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(problem_with("a.off", "OFF\n4 1 0\n" + vertices + "3 0 1 2\n3 0 2 3\n"),
            "line 8: the file goes on after the 4 vertices and 1 faces that it announces");
  EXPECT_EQ(problem_with("a.off", "OFF\n4 0 0\n" + vertices + "3 0 1 2\n"),
            "line 7: the file goes on after the 4 vertices and 0 faces that it announces");
  EXPECT_EQ(problem_with("a.off", "OFF\n3 1 0\n" + vertices + "3 0 1 2\n"),
            "line 7: the file goes on after the 3 vertices and 1 faces that it announces");
  EXPECT_EQ(problem_with("a.off", "OFF\n4 2 0\n" + vertices + "3 1 2\n3 0 1 2\n3 0 2 3\n"),
            "line 8: the face that begins in line 7 ends within this line");
  expect_square("OFF\n4 1 99\n" + kSquareBody + "\n\n# 3 0 1 2\n");  // a wrong number of edges
  expect_square("OFF\n4 1 0\n" + kSquareBody + std::string("\x1A\0 \0", 4));
}

TEST(Off, KeepsVerticesThatAreNotFiniteOutOfTheWay) {
  const std::string unused = "OFF\n5 2 0\n0 0 0\nnan nan nan\n1 0 0\n1 1 0\n0 1 0\n";
  expect_square(unused + "3 0 2 3\n3 0 3 4\n");
  EXPECT_EQ(problem_with("a.off", unused + "3 0 2 3\n3 0 3 1\n"), "line 4: a coordinate is not finite");
  EXPECT_EQ(read_cloud("a.off", "NOFF\n3 0 0\n0 0 0 1 0 0\n0 -inf 0 0 1 0\n1 2 3 0 0 1\n").normals,
            (std::vector<Vec3>{{1, 0, 0}, {0, 0, 1}}));
}

std::string binary_square(const std::string& name, bool with_normals, const std::string& colour) {
  std::string bytes = name + " BINARY\n" + big(std::int32_t{4}) + big(std::int32_t{1}) + big(std::int32_t{0});
  for (const Vec3& vertex : kSquareVertices) {
    for (const double c : vertex) {
      bytes += big(static_cast<float>(c));
    }
    bytes += with_normals ? big(0.0F) + big(0.0F) + big(1.0F) : "";
  }
  bytes += big(std::int32_t{4});
  for (std::int32_t i = 0; i < 4; ++i) {
    bytes += big(i);
  }
  return bytes + colour;
}

const std::string kNoColour = big(std::int32_t{0});

TEST(Off, ReadsBytes) {
  expect_square(binary_square("OFF", false, kNoColour));
  expect_square(binary_square("NOFF", true, kNoColour));
  expect_square(binary_square("OFF", false, big(std::int32_t{2}) + big(0.5F) + big(0.5F)));
  expect_square(binary_square("OFF", false, kNoColour) + "trailing");
}

TEST(Off, ChecksBytes) {
  const std::string good = binary_square("OFF", false, kNoColour);
  EXPECT_EQ(problem_with("a.off", good.substr(0, 40)),
            "byte 23: announces 4 vertices, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.off", good.substr(0, 75)),
            "byte 71: announces 1 faces, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.off", good.substr(0, 90)),
            "byte 75: announces 4 corners, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.off", good.substr(0, good.size() - 1)),
            "byte 91: expected the numbers of a colour, but the file ends here");
  EXPECT_EQ(problem_with("a.off", "OFF BINARY\n" + big(std::int32_t{-1})),
            "byte 11: expected the number of vertices, found -1");
  std::string bad = good;
  bad[good.size() - 5] = '\4';
  EXPECT_EQ(problem_with("a.off", bad), "face 0: vertex index 4 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.off", good + good.substr(good.size() - 24)),
            "24 bytes follow the 4 vertices and 1 faces that it announces");
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
  EXPECT_EQ(problem_with("a.off", "OFF BINARY\n"), "byte 11: expected the number of vertices, but the file ends here");
  EXPECT_EQ(problem_with("a.off", "OFF\n0 0 0\n"), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.off", "OFF\nx 1\n"), "line 2: expected the number of vertices, found 'x'");
  EXPECT_EQ(problem_with("a.off", "OFF\n-1 1\n"), "line 2: expected the number of vertices, found '-1'");
}

TEST(Off, NamesTheLineOfABadNumber) {
  const std::string head = "OFF\n1 0 0\n";
  EXPECT_EQ(problem_with("a.off", head + "0 0 nan\n"), "holds only points without finite coordinates");
  EXPECT_EQ(problem_with("a.off", head + "0 1e999 0\n"), "line 3: '1e999' is too large for a number");
  EXPECT_EQ(problem_with("a.off", head + "0 0x10 0\n"), "line 3: expected a coordinate, found '0x10'");
  EXPECT_EQ(problem_with("a.off", head + "0 +-1 0\n"), "line 3: expected a coordinate, found '+-1'");
  EXPECT_EQ(problem_with("a.off", head + "0 0,5 0\n"),
            "line 3: expected a coordinate, found '0,5' (a point is the decimal mark, not a comma)");
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
  test::expect_survives_damage("a.off", "OFF 4 2\n0 0 0 1 0 0 1 1 0\n0 nan 0\n3 0 1 2\n3 2 1 0 9 9 9\n");
  test::expect_survives_damage("a.off", binary_square("NOFF", true, kNoColour));
  test::expect_survives_damage("a.off", "COFF\n4 1 4\n0 0 0\n1 0 0 # x\r\n1 1 0 .5 .5 1\n0 1e0 0\n4 0 1 2 3 255 0 0\n");
}

}  // namespace
}  // namespace spincat
