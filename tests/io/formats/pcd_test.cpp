#include <fmt/format.h>
#include <gtest/gtest.h>

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
using test::read_cloud;

const float kNanFloat = std::numeric_limits<float>::quiet_NaN();
const std::vector<Vec3> kTwoPoints{{0, 0.5, 0}, {1, 2, 3}};

std::string header(const std::string& fields, int points, const std::string& data) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n{}WIDTH {}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      fields, points, points, data);
}

const std::string kXyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) {
    bytes += little(value);
  }
  return bytes;
}

// Packs as LZF allows: literal runs only.
std::string pack_plainly(const std::string& bytes) {
  std::string packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string run = bytes.substr(at, 32);
    packed += static_cast<char>(run.size() - 1) + run;
  }
  return packed;
}

std::string compressed(const std::string& packed, std::size_t size) {
  return little(static_cast<std::uint32_t>(packed.size())) + little(static_cast<std::uint32_t>(size)) + packed;
}

TEST(Pcd, ReadsText) {
  const PointCloud cloud = read_cloud("a.pcd", header(kXyz, 2, "ascii") + "0 0.5 0\n1 2 3\n");
  EXPECT_EQ(cloud.points, kTwoPoints);
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_FALSE(cloud.sensor);
}

TEST(Pcd, ReadsBytes) {
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 2, "binary") + floats({0, 0.5F, 0, 1, 2, 3})).points, kTwoPoints);
}

TEST(Pcd, ReadsCompressedBytesFieldByField) {
  const std::string by_field = floats({0, 1, 0.5F, 2, 0, 3});
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 2, "binary_compressed") + compressed(pack_plainly(by_field), 24)).points,
            kTwoPoints);
}

TEST(Pcd, UnpacksCopiesThatOverlap) {
  // One zero byte, then 9 + 2 = 11 copies of it from one byte back: three floats of zero.
  const std::string packed("\x00\x00\xe0\x02\x00", 5);
  const PointCloud cloud = read_cloud("a.pcd", header(kXyz, 1, "binary_compressed") + compressed(packed, 12));
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{0, 0, 0}}));
}

TEST(Pcd, FindsItsFieldsInAnyOrder) {
  const std::string fields =
      "FIELDS rgb normal_z z histogram y normal_x _ x normal_y\nSIZE 4 4 8 2 4 4 1 2 4\nTYPE U F F I F F U I F\n"
      "COUNT 1 1 1 3 1 1 5 1 1\n";
  const std::string text = "16711680 1 3 7 8 9 2 0 0 0 0 0 0 1 0\n";
  const std::string bytes = little(std::uint32_t{16711680}) + little(1.0F) + little(3.0) + little(std::int16_t{7}) +
                            little(std::int16_t{8}) + little(std::int16_t{9}) + little(2.0F) + little(0.0F) +
                            std::string(5, '\0') + little(std::int16_t{1}) + little(0.0F);
  for (const std::string& file :
       {header(fields, 1, "ascii") + text, header(fields, 1, "binary") + bytes,
        header(fields, 1, "binary_compressed") + compressed(pack_plainly(bytes), bytes.size())}) {
    const PointCloud cloud = read_cloud("a.pcd", file);
    EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}}));
    EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 1}}));
  }
}

TEST(Pcd, ReadsEverySizeOfInteger) {
  const std::string fields = "FIELDS x y z\nSIZE 1 2 8\nTYPE U U I\n";  // no COUNT: one each
  const std::string bytes = little(std::uint8_t{255}) + little(std::uint16_t{65535}) + little(std::int64_t{-7});
  EXPECT_EQ(read_cloud("a.pcd", header(fields, 1, "binary") + bytes).points, (std::vector<Vec3>{{255, 65535, -7}}));
}

TEST(Pcd, TakesTypesInLowerCaseAndFieldsInUpper) {
  const std::string lower = "FIELDS x y z\nSIZE 4 4 4\nTYPE f f f\nCOUNT 1 1 1\n";
  EXPECT_EQ(read_cloud("a.pcd", header(lower, 2, "binary") + floats({0, 0.5F, 0, 1, 2, 3})).points, kTwoPoints);
  const std::string integers = "FIELDS x y z\nSIZE 1 2 8\nTYPE u U i\n";
  const std::string bytes = little(std::uint8_t{255}) + little(std::uint16_t{65535}) + little(std::int64_t{-7});
  EXPECT_EQ(read_cloud("a.pcd", header(integers, 1, "binary") + bytes).points, (std::vector<Vec3>{{255, 65535, -7}}));
  const std::string upper = "FIELDS Z Y X Normal_X NORMAL_Y normal_z\n";
  const PointCloud cloud = read_cloud("a.pcd", header(upper, 1, "ascii") + "3 2 1 1 0 0\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}}));
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{1, 0, 0}}));
  EXPECT_EQ(read_cloud("a.pcd", header("FIELDS X x y z\n", 1, "ascii") + "9 1 2 3\n").points,
            (std::vector<Vec3>{{1, 2, 3}}));
}

TEST(Pcd, TakesItsWordsInEitherCase) {
  EXPECT_EQ(
      read_cloud("a.pcd", "version 0.7\nfields x y z\nsize 4 4 4\ntype f f f\npoints 2\ndata ASCII\n0 0.5 0\n1 2 3\n")
          .points,
      kTwoPoints);
}

TEST(Pcd, PassesOverFieldsWithoutValues) {
  const std::string fields = "FIELDS _ x y _ z\nSIZE 1 4 4 8 4\nTYPE U F F F F\nCOUNT 0 1 1 0 1\n";
  EXPECT_EQ(read_cloud("a.pcd", header(fields, 2, "ascii") + "0 0.5 0\n1 2 3\n").points, kTwoPoints);
  EXPECT_EQ(read_cloud("a.pcd", header(fields, 2, "binary") + floats({0, 0.5F, 0, 1, 2, 3})).points, kTwoPoints);
  const std::string packed = compressed(pack_plainly(floats({0, 1, 0.5F, 2, 0, 3})), 24);
  EXPECT_EQ(read_cloud("a.pcd", header(fields, 2, "binary_compressed") + packed).points, kTwoPoints);
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x y z\nCOUNT 1 0 1\nPOINTS 1\nDATA ascii\n1 2\n"),
            "its points have no field 'y'");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x y z\nCOUNT 0 0 0\nPOINTS 1\nDATA binary\n1 2\n"),
            "line 4: the count of each field is 0");
}

TEST(Pcd, RefusesMorePointsThanAnnounced) {
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 1, "ascii") + "0 0.5 0\n1 2 3\n"),
            "line 13: the file goes on after the 1 points that it announces");
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 1, "binary") + floats({0, 0.5F, 0, 1, 2, 3})),
            "12 bytes follow the 1 points that it announces");
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 2, "ascii") + "0 0.5 0\n1 2 3\n\n# the end\n").points, kTwoPoints);
  const std::string bytes = floats({0, 0.5F, 0, 1, 2, 3});
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 2, "binary") + bytes + std::string(4096, '\0')).points, kTwoPoints);
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 2, "binary") + bytes + "\r\nabc").points, kTwoPoints);
}

TEST(Pcd, RefusesARowWithAValueTooMany) {
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "ascii") + "7 0 0.5 0\n1 2 3\n"),
            "line 13: 0 more values than a row should have, but 1 more in line 12");
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "ascii") + "0 0.5 0\n7 1 2 3\n"),
            "line 13: 1 more values than a row should have, but 0 more in line 12");
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 2, "ascii") + "0 0.5 0 7\n1 2 3 7\n").points, kTwoPoints);
}

TEST(Pcd, LeavesOutWhatWasNotMeasured) {
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 3, "ascii") + "0 0.5 0\nnan nan nan\n1 2 3\n").points, kTwoPoints);
  const std::string bytes = floats({0, 0.5F, 0, kNanFloat, 0, 0, 1, 2, 3});
  EXPECT_EQ(read_cloud("a.pcd", header(kXyz, 3, "binary") + bytes).points, kTwoPoints);
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 1, "ascii") + "nan nan nan\n"),
            "holds only points without finite coordinates");
}

TEST(Pcd, TakesTheSensorFromTheViewpoint) {
  const std::string end = "POINTS 1\nDATA ascii\n1 2 3\n";
  EXPECT_EQ(read_cloud("a.pcd", kXyz + "VIEWPOINT 1 -2 0.5 1 0 0 0\n" + end).sensor, Vec3(1, -2, 0.5));
  EXPECT_EQ(read_cloud("a.pcd", kXyz + "VIEWPOINT 0 0 0 0 1 0 0\n" + end).sensor, Vec3(0, 0, 0));
  EXPECT_FALSE(read_cloud("a.pcd", kXyz + "VIEWPOINT 0 0 0 1 0 0 0\n" + end).sensor);
  EXPECT_FALSE(read_cloud("a.pcd", kXyz + end).sensor);
}

TEST(Pcd, CountsPointsByWidthAndHeight) {
  EXPECT_EQ(read_cloud("a.pcd", kXyz + "WIDTH 1\nHEIGHT 2\nDATA ascii\n0 0.5 0\n1 2 3\n").points, kTwoPoints);
  EXPECT_EQ(problem_with("a.pcd", kXyz + "WIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA ascii\n"),
            "line 8: WIDTH 2 x HEIGHT 2 is not POINTS 5");
  EXPECT_EQ(problem_with("a.pcd", kXyz + "WIDTH 4294967296\nHEIGHT 4294967296\nDATA ascii\n"),
            "line 7: WIDTH x HEIGHT is too large");
}

TEST(Pcd, RefusesInWords) {
  EXPECT_EQ(problem_with("a.pcd", ""), "is empty");
  EXPECT_EQ(problem_with("a.pcd", "# .PCD\nVERSION 0.7\n"), "line 3: the file ends within the header, before 'DATA'");
  EXPECT_EQ(problem_with("a.pcd", "ply\n"), "line 1: unknown word 'ply' in the header");
  EXPECT_EQ(problem_with("a.pcd", "POINTS 1\nDATA ascii\n"), "line 2: the header has no line 'FIELDS'");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x\nDATA ascii\n"), "line 2: the header says neither 'POINTS' nor 'WIDTH'");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x\nSIZE 3\n"), "line 2: a field's size must be 1, 2, 4 or 8, found 3");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x\nTYPE D\n"), "line 2: a field's type must be F, I or U, found 'D'");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x\nCOUNT 4294967296\n"),
            "line 2: a field's count must be at most 4294967295, found 4294967296");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x y\nSIZE 4\n"),
            "line 2: expected the size of a field, but the line ends here");
  EXPECT_EQ(problem_with("a.pcd", "FIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n"), "its points have no field 'z'");
  EXPECT_EQ(problem_with("a.pcd", header("FIELDS x y z\nSIZE 2 2 2\nTYPE F F F\n", 1, "binary") + "123456"),
            "field 'x': no floating-point number has 2 bytes");
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 1, "zip")),
            "line 11: unknown data format 'zip'; expected ascii, binary or binary_compressed");
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 0, "ascii")), "holds neither a face nor a point");
}

TEST(Pcd, NoticesMissingPoints) {
  const auto announced = [](int bytes) {
    return fmt::format("announces 2 points, more than fit into the {} bytes that follow", bytes);
  };
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "ascii") + "0 0 0\n"), announced(6));
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "binary") + floats({0, 0, 0})), announced(12));
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "binary_compressed") + "1234"), announced(4));
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "ascii") + "0.000 0.000 0.000\n"),
            "line 13: the file ends after 1 of 2 points");
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, "ascii") + "0.000 0.000\n0.000 0.000\n"),
            "line 12: expected a number, but the line ends here");
}

TEST(Pcd, RefusesFarTooManyFields) {
  std::string fields = "FIELDS x y z";
  for (int i = 3; i < 1'000; ++i) {
    fields += " a";
  }
  const std::string rest = "\nPOINTS 0\nDATA ascii\n";
  EXPECT_EQ(problem_with("a.pcd", fields + rest), "holds neither a face nor a point");
  EXPECT_EQ(problem_with("a.pcd", fields + " a" + rest), "line 1: more than 1000 fields");
}

TEST(Pcd, ChecksCompressedSizes) {
  const std::string head = header(kXyz, 1, "binary_compressed");
  const std::string damaged = "its compressed points are damaged";
  EXPECT_EQ(problem_with("a.pcd", head + compressed("x", 11)),
            "its 1 points of 12 bytes do not make up the 11 bytes that are compressed");
  EXPECT_EQ(problem_with("a.pcd", head + compressed(pack_plainly(std::string(11, 'x')), 12)), damaged);
  EXPECT_EQ(problem_with("a.pcd", head + compressed(pack_plainly(std::string(13, 'x')), 12)), damaged);
  EXPECT_EQ(problem_with("a.pcd", head + compressed(std::string("\xe0\x02\x00", 3), 12)), damaged);  // nothing behind
  EXPECT_EQ(problem_with("a.pcd", head + compressed(std::string("\x05zz", 3), 12)), damaged);
  EXPECT_EQ(problem_with("a.pcd", head + compressed(std::string("\x00z\xe0", 3), 12)), damaged);
  EXPECT_EQ(problem_with("a.pcd", header(kXyz, 1000, "binary_compressed") + compressed(std::string(100, 'x'), 12000)),
            damaged);
}

TEST(Pcd, KeepsToTheLimits) {
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    EXPECT_EQ(problem_with("a.pcd", header(kXyz, 2, data), {.max_points = 1}),
              "holds more than 1 points; --max-points raises this limit");
  }
}

TEST(Pcd, SurvivesDamage) {
  const std::string bytes = floats({0, 0.5F, 0, 1, 2, 3});
  test::expect_survives_damage("a.pcd", header(kXyz, 2, "ascii") + "0 0.5 0\n1 nan 3\n");
  test::expect_survives_damage("a.pcd", header(kXyz, 2, "binary") + bytes);
  test::expect_survives_damage("a.pcd", header(kXyz, 2, "binary_compressed") + compressed(pack_plainly(bytes), 24));
  const std::string packed("\x00\x00\xe0\x02\x00", 5);
  test::expect_survives_damage("a.pcd", header(kXyz, 1, "binary_compressed") + compressed(packed, 12));
}

}  // namespace
}  // namespace spincat
