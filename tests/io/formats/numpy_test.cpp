#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"
#include "io/zip_bytes.h"

namespace spincat {
namespace {

using test::big;
using test::little;
using test::little_row;
using test::problem_with;
using test::read_cloud;
using test::zip;

std::string npy(const std::string& type, const std::string& shape, const std::string& numbers,
                bool columns_first = false, char version = 1) {
  std::string text =
      fmt::format("{{'descr': {}, 'fortran_order': {}, 'shape': {}, }}", type, columns_first ? "True" : "False", shape);
  text += "\n";
  const std::string length =
      version == 1 ? little(static_cast<std::uint16_t>(text.size())) : little(static_cast<std::uint32_t>(text.size()));
  return "\x93NUMPY" + std::string{version, '\0'} + length + text + numbers;
}

const std::vector<Vec3> kPoints = {{1, 2, 3}, {4, 5, 6}};

TEST(Numpy, ReadsEveryTypeOfNumber) {
  EXPECT_EQ(read_cloud("a.npy", npy("'<f4'", "(2, 3)", little_row<float>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<f8'", "(2, 3)", little_row<double>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'|i1'", "(2, 3)", little_row<std::int8_t>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'|u1'", "(2, 3)", little_row<std::uint8_t>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<i2'", "(2, 3)", little_row<std::int16_t>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<u2'", "(2, 3)", little_row<std::uint16_t>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<i4'", "(2, 3)", little_row<std::int32_t>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<i8'", "(2, 3)", little_row<std::int64_t>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("\"=f4\"", "(2, 3)", little_row<float>(1, 2, 3, 4, 5, 6))).points, kPoints);
  const std::string half = little_row<std::uint16_t>(0x3C00, 0x4000, 0xC200, 0x0001, 0x0400, 0x7C00, 0, 0, 0);
  EXPECT_EQ(read_cloud("a.npy", npy("'<f2'", "(3, 3)", half)).points, (std::vector<Vec3>{{1, 2, -3}, {0, 0, 0}}));
}

TEST(Numpy, ReadsEitherOrderOfBytesAndOfNumbers) {
  std::string numbers;
  for (int i = 1; i <= 6; ++i) {
    numbers += big(static_cast<float>(i));
  }
  EXPECT_EQ(read_cloud("a.npy", npy("'>f4'", "(2, 3)", numbers)).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<f4'", "(2, 3)", little_row<float>(1, 4, 2, 5, 3, 6), true)).points, kPoints);
}

TEST(Numpy, ReadsEveryVersion) {
  for (const char version : {'\1', '\2', '\3'}) {
    const std::string bytes = npy("'<f4'", "(2L, 3L)", little_row<float>(1, 2, 3, 4, 5, 6), false, version);
    EXPECT_EQ(read_cloud("a.npy", bytes).points, kPoints);
  }
}

TEST(Numpy, ReadsNormalsOfUnitLength) {
  const PointCloud cloud =
      read_cloud("a.npy", npy("'<f4'", "(2, 6)", little_row<float>(1, 2, 3, 0, 0, 1, 4, 5, 6, 0.6, 0, 0.8)));
  EXPECT_EQ(cloud.points, kPoints);
  ASSERT_EQ(cloud.normals.size(), 2U);
  EXPECT_EQ(cloud.normals[0], Vec3(0, 0, 1));
  const PointCloud coloured =
      read_cloud("a.npy", npy("'<f4'", "(2, 6)", little_row<float>(1, 2, 3, 255, 0, 1, 4, 5, 6, 0, 0, 1)));
  EXPECT_EQ(coloured.points, kPoints);
  EXPECT_TRUE(coloured.normals.empty());
}

TEST(Numpy, ReadsMoreColumnsAndPictures) {
  EXPECT_EQ(read_cloud("a.npy", npy("'<f4'", "(2, 4)", little_row<float>(1, 2, 3, 9, 4, 5, 6, 9))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<f4'", "(1, 2, 3)", little_row<float>(1, 2, 3, 4, 5, 6))).points, kPoints);
  EXPECT_EQ(read_cloud("a.npy", npy("'<f4'", "(2, 3)", little_row<float>(1, 2, 3, NAN, 5, 6))).points,
            (std::vector<Vec3>{{1, 2, 3}}));
}

TEST(Numpy, RefusesInWords) {
  const std::string six = little_row<float>(1, 2, 3, 4, 5, 6);
  EXPECT_EQ(problem_with("a.npy", "abc"), "is no NumPy array: it does not begin with its mark");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(2, 3)", six).substr(0, 9)), "is cut off within its header");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(2, 3)", six).substr(0, 40)), "is cut off within its header");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(3, 3)", six)), "is cut off: 6 of 9 numbers");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(4294967296, 4294967296, 3)", six)),
            "is cut off: 6 numbers do not make 4294967296 x 4294967296 x 3");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(6,)", six)),
            "holds an array of 6, which is no cloud; expected N x 3, or N x 6 with normals");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "()", six)),
            "holds an array of one number, which is no cloud; expected N x 3, or N x 6 with normals");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(3, 2)", six)),
            "holds an array of 3 x 2, which is no cloud; expected N x 3, or N x 6 with normals (numpy.transpose turns "
            "it)");
  EXPECT_EQ(problem_with("a.npy", npy("'|u1'", "(1, 2, 3)", "abcdef")),
            "holds an array of 1 x 2 x 3, which is no cloud; expected N x 3, or N x 6 with normals");
  EXPECT_EQ(problem_with("a.npy", npy("'|O'", "(2, 3)", six)),
            "holds values of the type '|O'; expected numbers (f2 f4 f8 i1 to i8 u1 to u8)");
  EXPECT_EQ(problem_with("a.npy", npy("[('x', '<f4')]", "(2,)", six)),
            "holds records with names; expected one array of numbers, a point a row");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "7", six)), "is no NumPy array: its 'shape' is no tuple");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(2, a)", six)),
            "is no NumPy array: its 'shape' is no tuple of numbers");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(2, 3)", six, false, 9)),
            "is a NumPy array of version 9; spincat reads 1 to 3");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(0, 3)", "")), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.npy", npy("'<f4'", "(2, 3)", six), {.max_points = 1}),
            "holds more than 1 points; --max-points raises this limit");
}

const std::string kCloud = npy("'<f4'", "(2, 3)", little_row<float>(1, 2, 3, 4, 5, 6));
const std::string kOther = npy("'<f4'", "(1, 3)", little_row<float>(7, 8, 9));
const std::string kLabels = npy("'<i8'", "(2,)", little_row<std::int64_t>(0, 1));

TEST(Npz, ReadsTheOnlyArrayThatFits) {
  for (const bool packed : {false, true}) {
    EXPECT_EQ(
        read_cloud("a.npz", zip({{"labels.npy", kLabels}, {"arr_0.npy", kCloud}, {"note.txt", "x"}}, packed)).points,
        kPoints);
  }
}

TEST(Npz, GoesByTheName) {
  for (const char* name : {"points", "xyz", "pos", "vertices"}) {
    const std::string bytes = zip({{"a.npy", kOther}, {std::string(name) + ".npy", kCloud}});
    EXPECT_EQ(read_cloud("a.npz", bytes).points, kPoints) << name;
  }
  EXPECT_EQ(problem_with("a.npz", zip({{"a.npy", kOther}, {"b.npy", kCloud}})),
            "holds 2 arrays that may be the cloud: 'a', 'b'; call one of them 'points'");
}

TEST(Npz, ReadsNormalsBesideThePoints) {
  const std::string normals = npy("'<f4'", "(2, 3)", little_row<float>(0, 0, 1, 1, 0, 0));
  const PointCloud cloud = read_cloud("a.npz", zip({{"points.npy", kCloud}, {"normals.npy", normals}}));
  EXPECT_EQ(cloud.points, kPoints);
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_TRUE(read_cloud("a.npz", zip({{"points.npy", kCloud}, {"normals.npy", kOther}})).normals.empty());
}

TEST(Npz, RefusesInWords) {
  EXPECT_EQ(problem_with("a.npz", zip({{"labels.npy", kLabels}})),
            "holds no array that is a cloud; expected N x 3, or N x 6 with normals");
  EXPECT_EQ(problem_with("a.npz", "PK, but no archive"), "is no ZIP archive, or is cut off");
  std::string damaged = zip({{"points.npy", kCloud}}, false);
  damaged[damaged.find(little(2.0F))] ^= 1;
  EXPECT_EQ(problem_with("a.npz", damaged), "its part 'points.npy' is damaged");
}

// A megabyte of zeros takes a kilobyte.
TEST(Npz, IsBounded) {
  const std::string zeros = npy("'<f4'", "(5000000, 3)", std::string(60'000'000, '\0'));
  const std::string problem = problem_with("a.npz", zip({{"points.npy", zeros}}));
  EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
}

TEST(Numpy, SurvivesDamage) {
  test::expect_survives_damage("a.npy", kCloud);
  test::expect_survives_damage("a.npz", zip({{"points.npy", kCloud}, {"labels.npy", kLabels}}));
  test::expect_survives_damage("a.npz", zip({{"points.npy", kCloud}}, false));
}

}  // namespace
}  // namespace spincat
