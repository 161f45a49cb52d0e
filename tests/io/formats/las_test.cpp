#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"

namespace spincat {
namespace {

using test::little;
using test::little_row;
using test::problem_with;
using test::read_cloud;

struct Las {
  int minor = 2;
  int format = 0;
  std::size_t record = 20;
  std::uint64_t count = 2;
  bool counted_in_64_bits = false;

  // Points at (1, 2, 3) and (-1, 0, 0.5) steps of 0.01 around (500000, 4000000, 100).
  std::string bytes() const {
    const std::size_t header = minor >= 4 ? 375 : 227;
    std::string text = "LASF" + std::string(20, '\0') + little_row<std::uint8_t>(1, minor);
    text.resize(94);
    text += little_row<std::uint16_t>(header) + little_row<std::uint32_t>(header + 5, 0);
    text += little_row<std::uint8_t>(format) + little_row<std::uint16_t>(record);
    text += little_row<std::uint32_t>(counted_in_64_bits ? 0 : count) + std::string(20, '\0');
    text += little_row<double>(0.01, 0.01, 0.01, 500000, 4000000, 100);
    text.resize(227);
    if (minor >= 4) {
      text.resize(247);
      text += little(count);
    }
    text.resize(header + 5);  // and a variable record of five bytes
    for (const auto& point : {little_row<std::int32_t>(100, 200, 300), little_row<std::int32_t>(-100, 0, 50)}) {
      text += point + std::string(record - 12, 'x');
    }
    return text;
  }
};

const std::vector<Vec3> kPoints = {{500001, 4000002, 103}, {499999, 4000000, 100.5}};

TEST(Las, ReadsEveryFormatOfPoints) {
  constexpr std::size_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  for (int format = 0; format <= 10; ++format) {
    for (const std::size_t more : {0, 7}) {  // bytes of the program's own
      const Las las{.minor = 4, .format = format, .record = sizes[format] + more, .counted_in_64_bits = format > 5};
      test::expect_near(read_cloud("a.las", las.bytes()).points, kPoints);
    }
  }
}

TEST(Las, ReadsEveryVersion) {
  for (const int minor : {0, 1, 2, 3, 4}) {
    const PointCloud cloud = read_cloud("A.LAS", Las{.minor = minor}.bytes());
    test::expect_near(cloud.points, kPoints);
    EXPECT_FALSE(cloud.sensor);
    EXPECT_TRUE(cloud.normals.empty());
  }
}

TEST(Las, RefusesInWords) {
  const std::string good = Las().bytes();
  EXPECT_EQ(problem_with("a.las", "LAS"), "is no LAS file: it does not begin with 'LASF'");
  EXPECT_EQ(problem_with("a.las", good.substr(0, 226)), "is cut off within its header");
  EXPECT_EQ(problem_with("a.las", good.substr(0, good.size() - 1)), "is cut off: 1 of 2 points");
  EXPECT_EQ(problem_with("a.las", Las{.minor = 5}.bytes()), "is a LAS file of version 1.5; spincat reads 1.0 to 1.4");
  EXPECT_EQ(problem_with("a.las", Las{.format = 11}.bytes()), "has points of the format 11; spincat reads 0 to 10");
  EXPECT_EQ(problem_with("a.las", Las{.format = 1}.bytes()), "has points of 20 bytes; those of its format, 1, have 28");
  EXPECT_EQ(problem_with("a.las", Las{.format = 0x80}.bytes()),
            "is compressed (LAZ), which spincat does not read; convert it with PDAL: pdal translate a.laz a.las");
  EXPECT_EQ(problem_with("a.las", Las{.count = 0}.bytes()), "holds neither a face nor a point");
  std::string bad = good;
  bad.replace(131, 8, little(HUGE_VAL));
  EXPECT_EQ(problem_with("a.las", bad), "has a scale or an offset that is not finite");
}

TEST(Las, TakesNothingForPointsThatAreNotThere) {
  EXPECT_EQ(problem_with("a.las", Las{.minor = 4, .count = 0xFFFF'FFFF'FFFF, .counted_in_64_bits = true}.bytes()),
            "is cut off: 2 of 281474976710655 points");
  EXPECT_EQ(problem_with("a.las", Las().bytes(), {.max_points = 1}),
            "holds more than 1 points; --max-points raises this limit");
}

TEST(Las, SurvivesDamage) {
  test::expect_survives_damage("a.las", Las{.minor = 4}.bytes());
}

}  // namespace
}  // namespace spincat
