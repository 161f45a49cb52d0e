#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"

namespace spincat {
namespace {

using test::big;
using test::little;
using test::problem_with;
using test::read_cloud;
using test::read_mesh;

const std::vector<Vec3> kSquareVertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kSquareTriangles{{0, 1, 2}, {0, 2, 3}};

void expect_square(const std::string& bytes) {
  const Mesh mesh = read_mesh("square.ply", bytes);
  EXPECT_EQ(mesh.vertices, kSquareVertices);
  EXPECT_EQ(mesh.triangles, kSquareTriangles);
}

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kSquareElements =
    "element vertex 4\n" + kXyz + "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kSquareText = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

template <typename Write>
std::string square_bytes(Write write) {
  std::string bytes;
  for (const Vec3& vertex : kSquareVertices) {
    for (const double c : vertex) {
      bytes += write(static_cast<float>(c));
    }
  }
  bytes += write(std::uint8_t{4});
  for (std::int32_t i = 0; i < 4; ++i) {
    bytes += write(i);
  }
  return bytes;
}

const auto kWriteLittle = [](auto value) { return little(value); };
const auto kWriteBig = [](auto value) { return big(value); };

TEST(Ply, ReadsText) {
  expect_square(header("ascii", kSquareElements) + kSquareText);
  expect_square(header("ascii", "comment hello # there\nobj_info element face 7\n" + kSquareElements) + kSquareText);
  expect_square(
      "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
      "0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3");
}

TEST(Ply, ReadsBothByteOrders) {
  expect_square(header("binary_little_endian", kSquareElements) + square_bytes(kWriteLittle));
  expect_square(header("binary_big_endian", kSquareElements) + square_bytes(kWriteBig));
  expect_square(header("binary_little_endian", kSquareElements) + square_bytes(kWriteLittle) + "trailing");
}

TEST(Ply, KnowsEveryNameOfEveryType) {
  for (const std::string type : {"char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int", "int32",
                                 "uint", "uint32", "float", "float32", "double", "float64"}) {
    expect_square(header("ascii", "element vertex 4\nproperty " + type + " x\nproperty " + type + " y\nproperty " +
                                      type + " z\nelement face 1\nproperty list " + type + " " + type +
                                      " vertex_index\n") +
                  kSquareText);
  }
}

TEST(Ply, ReadsBinaryNumbersOfEverySize) {
  const std::string elements =
      "element vertex 3\nproperty double x\nproperty short y\nproperty char z\n"
      "element face 1\nproperty list ushort uint8 vertex_index\n";
  std::string bytes;
  for (int i = 0; i < 3; ++i) {
    bytes += little(i + 0.5) + little(std::int16_t(-300 * i)) + little(std::int8_t(-i));
  }
  bytes += little(std::uint16_t{3}) + std::string("\0\1\2", 3);
  const Mesh mesh = read_mesh("a.ply", header("binary_little_endian", elements) + bytes);
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0.5, 0, 0}, {1.5, -300, -1}, {2.5, -600, -2}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Ply, TakesNamesOfCoordinatesInEitherCase) {
  expect_square(header("ascii",
                       "element vertex 4\nproperty float X\nproperty float Y\nproperty float Z\nelement face 1\n"
                       "property list uchar int vertex_indices\n") +
                kSquareText);
}

TEST(Ply, PassesOverWhatItDoesNotKnow) {
  const std::string elements =
      "element camera 1\nproperty float fov\nproperty list int short samples\n"
      "element vertex 4\nproperty uchar red\nproperty list uchar double weights\nproperty float x\n"
      "property float y\nproperty float z\nproperty int id\n"
      "element nothing 99999999999\n"
      "element face 1\nproperty list uint8 float texcoord\nproperty list uchar int vertex_indices\nproperty int flags\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  std::string text = "60.5 3 1 2 3\n";
  std::string bytes = little(60.5F) + little(std::int32_t{3}) + little(std::int16_t{1}) + little(std::int32_t{9});
  for (const Vec3& v : kSquareVertices) {
    text += fmt::format("255 2 0.5 0.5 {} {} {} 7\n", v.x(), v.y(), v.z());
    bytes += '\xff' + std::string(1, '\2') + little(0.5) + little(0.5);
    for (const double c : v) {
      bytes += little(static_cast<float>(c));
    }
    bytes += little(std::int32_t{7});
  }
  text += "2 0.1 0.2 4 0 1 2 3 1\n0 1\n";
  bytes += '\1' + little(0.1F) + '\4';
  for (std::int32_t i = 0; i < 4; ++i) {
    bytes += little(i);
  }
  bytes += little(std::int32_t{1}) + little(std::int32_t{0}) + little(std::int32_t{1});
  expect_square(header("ascii", elements) + text);
  expect_square(header("binary_little_endian", elements) + bytes);
}

TEST(Ply, TakesFacesBeforeVertices) {
  expect_square(header("ascii", "element face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n" + kXyz) +
                "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n");
}

const std::string kStripElements =
    "element vertex 4\n" + kXyz + "element tristrips 1\nproperty list int int vertex_indices\n";
const std::string kCornersText = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string strip_bytes(const std::vector<std::int32_t>& indices, auto write) {
  std::string bytes;
  for (const Vec3& vertex : kSquareVertices) {
    for (const double c : vertex) {
      bytes += write(static_cast<float>(c));
    }
  }
  bytes += write(static_cast<std::int32_t>(indices.size()));
  for (const std::int32_t index : indices) {
    bytes += write(index);
  }
  return bytes;
}

std::vector<Triangle> triangles_of_strip(const std::string& list) {
  return read_mesh("a.ply", header("ascii", kStripElements) + kCornersText + list).triangles;
}

TEST(Ply, TurnsEverySecondTriangleOfAStrip) {
  EXPECT_EQ(triangles_of_strip("4 0 1 3 2\n"), (std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}}));
  EXPECT_EQ(triangles_of_strip("6 0 1 2 3 0 1\n"), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 0}, {0, 3, 1}}));
}

TEST(Ply, BeginsAStripAnewBehindMinusOne) {
  const std::vector<Triangle> two{{0, 1, 3}, {1, 2, 3}};
  EXPECT_EQ(triangles_of_strip("7 0 1 3 -1 1 2 3\n"), two);
  EXPECT_EQ(triangles_of_strip("9 0 1 3 -1 -1 1 2 3 -1\n"), two);
  EXPECT_EQ(triangles_of_strip("9 0 1 -1 0 1 3 -1 2 3\n"), (std::vector<Triangle>{{0, 1, 3}}));
  for (const auto& [format, bytes] :
       {std::pair("binary_little_endian", strip_bytes({0, 1, 3, -1, 1, 2, 3}, kWriteLittle)),
        std::pair("binary_big_endian", strip_bytes({0, 1, 3, -1, 1, 2, 3}, kWriteBig))}) {
    for (const std::string type : {"int", "uint"}) {
      std::string elements = kStripElements;
      elements.replace(elements.find("int int vert"), 7, "int " + type);
      EXPECT_EQ(read_mesh("a.ply", header(format, elements) + bytes).triangles, two) << format << type;
    }
  }
}

TEST(Ply, DropsFlatTrianglesOfAStripButKeepsCount) {
  EXPECT_EQ(triangles_of_strip("6 0 1 1 3 2 0\n"), (std::vector<Triangle>{{1, 3, 2}, {2, 3, 0}}));
  EXPECT_EQ(triangles_of_strip("5 0 1 0 3 2\n"), (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}}));
}

TEST(Ply, ReadsSeveralStripsBesideFaces) {
  const std::string elements = "element vertex 4\n" + kXyz +
                               "element face 1\nproperty list uchar int vertex_indices\n"
                               "element tristrips 2\nproperty list uchar char vertex_index\n";
  EXPECT_EQ(
      read_mesh("a.ply", header("ascii", elements) + kCornersText + "3 0 1 2\n3 0 2 3\n7 3 1 0 -1 2 1 0\n").triangles,
      (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 1, 0}, {2, 1, 0}}));
}

TEST(Ply, ChecksStrips) {
  const std::string head = header("ascii", kStripElements) + kCornersText;
  EXPECT_EQ(problem_with("a.ply", head + "3 0 1 4\n"), "line 14: vertex index 4 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.ply", head + "3 0 1 -2\n"), "line 14: vertex index -2 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.ply", head + "9 0 1 2\n"),
            "line 14: a list of 9 values does not fit into the rest of the file");
}

TEST(Ply, PassesOverValuesThatEachRowHasTooMany) {
  const std::string elements =
      "element vertex 4\n" + kXyz + "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n";
  const std::string head = header("ascii", elements);
  expect_square(head + kCornersText + "3 0 1 2 9 1 1 1\n3 0 2 3 9 1 1 1\n");
  expect_square(head + kCornersText + "3 0 1 2 9 6 0.25 .5 1 0 1 1\n3 0 2 3 9 6 0.25 .5 1 0 1 1\n");
  expect_square(head + "0 0 0 7\n1 0 0 7\n1 1 0 7\n0 1 0 7\n3 0 1 2 9\n3 0 2 3 9\n");
}

TEST(Ply, RefusesARowWithAValueTooMany) {
  const std::string head = header("ascii", kSquareElements);  // 9 lines
  EXPECT_EQ(problem_with("a.ply", head + "7 0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
            "line 11: 0 more values than a row should have, but 1 more in line 10");
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 0\n7 1 1 0\n0 1 0\n4 0 1 2 3\n"),
            "line 12: 1 more values than a row should have, but 0 more in line 10");
  const std::string faces = "element vertex 4\n" + kXyz + "element face 2\nproperty list uchar int vertex_indices\n";
  EXPECT_EQ(problem_with("a.ply", header("ascii", faces) + kCornersText + "3 0 1 2\n3 0 2 3 1\n"),
            "line 15: 1 more values than a row should have, but 0 more in line 14");
}

TEST(Ply, TakesAnyBlankBetweenValuesWhereLinesDoNot) {
  expect_square(header("ascii", kSquareElements) + "0 0 0 1 0 0\n1 1 0 0 1 0\n4 0 1 2 3\n");
  expect_square(header("ascii", kSquareElements) + "0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3");
  expect_square(header("ascii", kSquareElements) + "0\n0\n0\n1 0 0\n1 1 0\n0 1 0\n4 0 1\n2 3\n");
}

TEST(Ply, RefusesMoreRowsThanAnnounced) {
  const std::string more = "the file goes on after the rows that the header announces";
  EXPECT_EQ(problem_with("a.ply", header("ascii", kSquareElements) + kCornersText + "3 0 1 2\n3 0 2 3\n"),
            "line 15: " + more);
  EXPECT_EQ(problem_with("a.ply", header("ascii", "element vertex 2\n" + kXyz) + kCornersText), "line 10: " + more);
  std::string none = kSquareElements;
  none.replace(none.find("face 1"), 6, "face 0");
  EXPECT_EQ(problem_with("a.ply", header("ascii", none) + kSquareText), "line 14: " + more);
  const std::string bytes = square_bytes(kWriteLittle);
  const std::string follow = " bytes follow the rows that the header announces";
  EXPECT_EQ(problem_with("a.ply", header("binary_little_endian", none) + bytes), "17" + follow);
  EXPECT_EQ(problem_with("a.ply", header("binary_little_endian", kSquareElements) + bytes + bytes.substr(48)),
            "17" + follow);
  EXPECT_EQ(problem_with("a.ply", header("binary_little_endian", "element vertex 2\n" + kXyz) + bytes.substr(0, 48)),
            "24" + follow);
}

TEST(Ply, TakesWhatFilesAreFilledUpWith) {
  const std::string padding = std::string(40, '\0') + std::string(40, ' ') + "\r\n\n\x1A";
  expect_square(header("ascii", kSquareElements) + kSquareText + "\n \n" + padding);
  expect_square(header("binary_little_endian", kSquareElements) + square_bytes(kWriteLittle) + padding);
}

TEST(Ply, KeepsVerticesThatAreNotFiniteOutOfTheWay) {
  std::string elements = kSquareElements;
  elements.replace(elements.find("vertex 4"), 8, "vertex 5");
  const std::string head = header("ascii", elements) + "nan nan nan\n" + kCornersText;
  expect_square(head + "4 1 2 3 4\n");
  EXPECT_EQ(problem_with("a.ply", head + "4 1 2 3 0\n"), "line 10: a coordinate is not finite");
}

TEST(Ply, IsAPointCloudWithoutFaces) {
  const std::string elements =
      "element vertex 3\n" + kXyz + "property float nx\nproperty float ny\nproperty float nz\n";
  const PointCloud cloud = read_cloud("a.ply", header("ascii", elements) + "0 0 0 1 0 0\nnan 0 0 0 1 0\n1 2 3 0 0 1\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}}));
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(cloud.sensor);

  const PointCloud bare = read_cloud(
      "a.ply", header("ascii", kSquareElements + "element face2 0\n") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n");
  EXPECT_EQ(bare.points, kSquareVertices);
  EXPECT_TRUE(bare.normals.empty());
}

TEST(Ply, RefusesInWords) {
  EXPECT_EQ(problem_with("a.ply", ""), "is empty");
  EXPECT_EQ(problem_with("a.ply", "OFF\n"), "line 1: expected the first line 'ply'");
  EXPECT_EQ(problem_with("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"),
            "line 5: the file ends within the header, before 'end_header'");
  EXPECT_EQ(problem_with("a.ply", "ply\nend_header\n"), "line 2: the header has no line 'format'");
  EXPECT_EQ(problem_with("a.ply", "ply\nformat middle_endian 1.0\n"),
            "line 2: unknown format 'middle_endian'; expected ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(problem_with("a.ply", "ply\nproperty float x\n"), "line 2: a property before the first element");
  EXPECT_EQ(problem_with("a.ply", "ply\nelement a 1\nproperty half x\n"), "line 3: unknown type 'half' of a property");
  EXPECT_EQ(problem_with("a.ply", "ply\nelement a 1\nelement a 1\n"), "line 3: a second element called 'a'");
  EXPECT_EQ(problem_with("a.ply", "ply\nelement a -1\n"), "line 2: expected the number of elements, found '-1'");
  EXPECT_EQ(problem_with("a.ply", "ply\nvertices 8\n"), "line 2: unknown word 'vertices' in the header");
  EXPECT_EQ(problem_with("a.ply", header("ascii", "")), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.ply", header("ascii", "element vertex 1\nproperty float x\n") + "1\n"),
            "its vertices have no property 'y'");
  EXPECT_EQ(problem_with("a.ply", header("ascii", "element vertex 1\n" + kXyz) + "nan nan nan\n"),
            "holds only points without finite coordinates");
}

TEST(Ply, ChecksTextNumbersAndIndices) {
  const std::string head = header("ascii", kSquareElements);  // 9 lines
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 4\n"),
            "line 14: vertex index 4 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1.5 2\n"),
            "line 14: vertex index 1.5 is out of range (4 vertices)");
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 nan\n1 1 0\n0 1 0\n3 0 1 2\n"),
            "line 11: a coordinate is not finite");
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 x\n1 1 0\n0 1 0\n3 0 1 2\n"),
            "line 11: expected a number, found 'x'");
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 0\n1 1 0\n"),
            "line 10: announces 4 x vertex, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.ply", head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n-1 0 1 2 4\n"),
            "line 14: a list of -1 values does not fit into the rest of the file");
}

TEST(Ply, ChecksBinaryCountsAndIndices) {
  const std::string head = header("binary_little_endian", kSquareElements);
  std::string body = square_bytes(kWriteLittle);
  EXPECT_EQ(problem_with("a.ply", head + body.substr(0, 40)),
            "vertex 0: announces 4 x vertex, more than fit into the rest of the file");
  EXPECT_EQ(problem_with("a.ply", head + body.substr(0, 60)),
            "face 0: a list of 4 values does not fit into the rest of the file");
  body[53] = '\4';
  EXPECT_EQ(problem_with("a.ply", head + body), "face 0: vertex index 4 is out of range (4 vertices)");
  body[53] = '\1';
  body.replace(12, 4, little(std::numeric_limits<float>::infinity()));
  EXPECT_EQ(problem_with("a.ply", head + body), "vertex 1: a coordinate is not finite");
  EXPECT_EQ(problem_with("a.ply", header("binary_little_endian", "element vertex 18446744073709551\n" + kXyz) + body),
            "holds more than 100000000 points; --max-points raises this limit");
}

// Vertices without properties take no bytes: they were passed over, and faces checked against their number.
TEST(Ply, RefusesFacesOfVerticesThatAreNotThere) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  for (const std::string properties : {"", "property float y\nproperty float z\n", "property list uchar float x\n"}) {
    EXPECT_EQ(problem_with("a.ply", header("ascii", "element vertex 3\n" + properties + faces) + "3 0 1 2\n"),
              "its vertices have no property 'x'");
  }
  EXPECT_EQ(problem_with("a.ply", header("ascii", faces + "element vertex 3\n") + "3 0 1 2\n"),
            "its vertices have no property 'x'");
  EXPECT_EQ(problem_with("a.ply", header("ascii", "element vertex 0\n" + faces) + "3 0 1 2\n"),
            "line 7: vertex index 0 is out of range (0 vertices)");
}

// Each name is compared with all before it: a header of a million elements must not take for ever.
TEST(Ply, RefusesFarTooManyElements) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz;
  for (int i = 1; i < 100; ++i) {
    text += "element e" + std::to_string(i) + " 0\n";
  }
  EXPECT_EQ(problem_with("a.ply", text + "end_header\n0 0 0\n"), "(nothing thrown)");
  EXPECT_EQ(problem_with("a.ply", text + "element more 0\nend_header\n0 0 0\n"), "line 106: more than 100 elements");
}

TEST(Ply, ShowsStrangeNamesInALine) {
  const std::string text = "ply\nformat ascii 1.0\nelement a\x1B[2J 9\nproperty char x\nend_header\n";
  EXPECT_EQ(problem_with("a.ply", text), "line 6: announces 9 x a?[2J, more than fit into the rest of the file");
}

TEST(Ply, KeepsToTheLimits) {
  const std::string text = header("ascii", kSquareElements) + kSquareText;
  EXPECT_EQ(problem_with("a.ply", text, {.max_points = 3}), "holds more than 3 points; --max-points raises this limit");
  EXPECT_EQ(problem_with("a.ply", text, {.max_triangles = 1}),
            "holds more than 1 triangles; --max-triangles raises this limit");
}

TEST(Ply, SurvivesDamage) {
  test::expect_survives_damage("a.ply", header("ascii", "comment x\n" + kSquareElements) + kSquareText);
  test::expect_survives_damage("a.ply", header("binary_little_endian", kSquareElements) + square_bytes(kWriteLittle));
  test::expect_survives_damage("a.ply", header("ascii", kStripElements) + kCornersText + "7 0 1 3 -1 1 2 3\n");
  test::expect_survives_damage(
      "a.ply", header("binary_big_endian", kStripElements) + strip_bytes({0, 1, 3, -1, 1, 2, 3}, kWriteBig));
  test::expect_survives_damage("a.ply", header("binary_big_endian", kSquareElements) + square_bytes(kWriteBig));
}

}  // namespace
}  // namespace spincat
