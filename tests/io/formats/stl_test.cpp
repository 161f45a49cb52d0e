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

using test::little;
using test::problem_with;
using test::read_mesh;

const std::vector<Vec3> kSquareVertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kSquareTriangles{{0, 1, 2}, {0, 2, 3}};

void expect_square(const std::string& bytes) {
  const Mesh mesh = read_mesh("square.stl", bytes);
  EXPECT_EQ(mesh.vertices, kSquareVertices);
  EXPECT_EQ(mesh.triangles, kSquareTriangles);
}

const std::string kFirstFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 1 1 0\n endloop\nendfacet\n";
const std::string kSecondFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0.0 -0 0\n  vertex 1 1 0\n  vertex 0 1e0 0\n endloop\nendfacet\n";

std::string binary(std::string title) {
  title.resize(80, ' ');
  std::string bytes = title + little(std::uint32_t{2});
  for (const Triangle& triangle : kSquareTriangles) {
    bytes += little(0.0F) + little(0.0F) + little(1.0F);
    for (const std::uint32_t corner : triangle) {
      for (const double c : kSquareVertices[corner]) {
        bytes += little(static_cast<float>(c));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

TEST(Stl, ReadsTextAndMergesEqualVertices) {
  expect_square("solid square\n" + kFirstFacet + kSecondFacet + "endsolid square\n");
}

TEST(Stl, ReadsSeveralSolids) {
  expect_square("solid one\n" + kFirstFacet + "endsolid one\n\nsolid\n" + kSecondFacet + "endsolid\n");
}

TEST(Stl, TakesEveryLineEndAndUpperCase) {
  std::string text =
      "SOLID\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\nVERTEX 1 1 0\r\n"
      "ENDLOOP\r\nENDFACET\r\n" +
      kSecondFacet + "ENDSOLID";
  expect_square(text);
  expect_square("  solid # a name, not a comment\n" + kFirstFacet + kSecondFacet + "endsolid\n");
}

TEST(Stl, TakesEndsInTwoWords) {
  std::string text = "solid a\n" + kFirstFacet + kSecondFacet + "endsolid a\n";
  for (const std::string part : {"loop", "facet", "solid"}) {
    std::string parted = text;
    for (std::size_t at = 0; (at = parted.find("end" + part, at)) != std::string::npos; ++at) {
      parted.insert(at + 3, " ");
    }
    ASSERT_NE(parted, text);
    expect_square(parted);
  }
  expect_square("SOLID a\n" + kFirstFacet + kSecondFacet + "End  Solid a\n");
}

TEST(Stl, PassesOverNotesBehindSolid) {
  expect_square("solid a\n; written by a converter\nunits: mm\n\n" + kFirstFacet + kSecondFacet + "endsolid a\n");
  expect_square("solid a\n" + kFirstFacet + "endsolid\nsolid b\n# note\n" + kSecondFacet + "endsolid\n");
  expect_square("solid\n" + std::string(300, '-') + "\n" + kFirstFacet + kSecondFacet + "endsolid\n");
  EXPECT_EQ(problem_with("a.stl", "solid a\n" + kFirstFacet + "; note\n" + kSecondFacet + "endsolid\n"),
            "line 9: expected 'facet', 'outer loop' or 'endsolid', found ';'");
}

TEST(Stl, RefusesFacetsThatAreNoTriangles) {
  const std::string begin = "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const std::string end = "endloop\nendfacet\nendsolid\n";
  EXPECT_EQ(problem_with("a.stl", begin + end), "line 6: only 2 corners in a facet, expected 3");
  EXPECT_EQ(problem_with("a.stl", begin + "vertex 1 1 0\nvertex 0 1 0\n" + end),
            "line 7: more than 3 corners in a facet, expected 3");
}

// Where the program that wrote it never came to fill in the count.
TEST(Stl, ReadsBytesWithoutACount) {
  std::string bytes = binary("x");
  bytes.replace(80, 4, little(std::uint32_t{0}));
  expect_square(bytes);
  EXPECT_EQ(problem_with("a.stl", bytes + "x"), "101 bytes follow the 0 triangles that it announces");
}

TEST(Stl, RefusesMoreTrianglesThanAnnounced) {
  std::string bytes = binary("x");
  bytes.replace(80, 4, little(std::uint32_t{1}));
  EXPECT_EQ(problem_with("a.stl", bytes), "50 bytes follow the 1 triangles that it announces");
  expect_square(binary("x") + std::string(49, 'x'));
  expect_square(binary("x") + std::string(500, '\0') + std::string(500, ' '));
}

TEST(Stl, ReadsBytes) {
  expect_square(binary("made by a test"));
  expect_square(binary("made by a test") + "trailing bytes");
}

TEST(Stl, ReadsBytesThatSaySolid) {
  expect_square(binary("solid square"));
  expect_square(binary("solid square") + "trailing bytes");
  expect_square(binary("solid facet\nx"));
}

TEST(Stl, KeepsNearlyEqualVerticesApart) {
  const std::string text = fmt::format(
      "solid\nfacet\nouter loop\nvertex 1 0 0\nvertex {:.17g} 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
      std::nextafter(1.0, 2.0));
  EXPECT_EQ(read_mesh("a.stl", text).vertices.size(), 3U);
}

TEST(Stl, MergesManyVertices) {
  std::string text = "solid\n";
  constexpr int steps = 3000;
  for (int i = 0; i < steps; ++i) {
    text +=
        fmt::format("facet\nouter loop\nvertex {} 0 0\nvertex {} 0 0\nvertex {} 1 0\nendloop\nendfacet\n", i, i + 1, i);
  }
  const Mesh mesh = read_mesh("a.stl", text + "endsolid\n");
  EXPECT_EQ(mesh.triangles.size(), std::size_t{steps});
  EXPECT_EQ(mesh.vertices.size(), std::size_t{2 * steps + 1});
  EXPECT_EQ(mesh.triangles[1][0], mesh.triangles[0][1]);
}

TEST(Stl, RefusesInWords) {
  EXPECT_EQ(problem_with("a.stl", ""), "is empty");
  EXPECT_EQ(problem_with("a.stl", "OFF\nx 0 0"), "is cut off: the header alone needs 84 bytes, it has 9");
  EXPECT_EQ(problem_with("a.stl", "solid\nendsolid\n"), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.stl", binary("x").substr(0, 150)), "is cut off: 2 triangles need 184 bytes, it has 150");
  EXPECT_EQ(problem_with("a.stl", "solid\n" + kFirstFacet), "line 9: the file ends before 'endsolid'");
  EXPECT_EQ(problem_with("a.stl", "solid\n" + kFirstFacet.substr(0, 60)), "line 5: the file ends within a facet");
  EXPECT_EQ(problem_with("a.stl", "solid\nfacet\nouter loop\nvertex 0 x 0\n"),
            "line 4: expected a coordinate, found 'x'");
  EXPECT_EQ(problem_with("a.stl", "solid\nfacet\nouter loop\nvertex 0 inf 0\n"),
            "line 4: a coordinate must be finite, found 'inf'");
  EXPECT_EQ(problem_with("a.stl", "solid\nfacet\nvertex 0 0 0\n"),
            "line 3: expected 'facet', 'outer loop' or 'endsolid', found 'vertex'");
  std::string bad = binary("x");
  bad.replace(84 + 50 + 12, 4, little(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(problem_with("a.stl", bad), "triangle 1: a coordinate is not finite");
}

TEST(Stl, KeepsToTheLimits) {
  for (const std::string& bytes : {binary("x"), "solid\n" + kFirstFacet + kSecondFacet + "endsolid\n"}) {
    EXPECT_EQ(problem_with("a.stl", bytes, {.max_points = 3}),
              "holds more than 3 points; --max-points raises this limit");
    EXPECT_EQ(problem_with("a.stl", bytes, {.max_triangles = 1}),
              "holds more than 1 triangles; --max-triangles raises this limit");
  }
}

TEST(Stl, SurvivesDamage) {
  test::expect_survives_damage("a.stl", "solid a\n" + kFirstFacet + "endsolid\nsolid\n" + kSecondFacet + "endsolid\n");
  test::expect_survives_damage("a.stl", binary("solid"));
}

}  // namespace
}  // namespace spincat
