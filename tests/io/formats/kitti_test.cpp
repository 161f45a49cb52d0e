#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"

namespace spincat {
namespace {

using test::little_row;
using test::problem_with;

TEST(Kitti, ReadsRowsOfFourFloats) {
  const std::string bytes = little_row<float>(1, 2, 3, 0.5, -4, 5, -6, 0);
  EXPECT_EQ(test::read_cloud("000000.bin", bytes).points, (std::vector<Vec3>{{1, 2, 3}, {-4, 5, -6}}));
}

TEST(Kitti, LeavesOutWhatIsNotMeasured) {
  const std::string bytes = little_row<float>(1, 2, 3, 0, NAN, 0, 0, 0);
  EXPECT_EQ(test::read_cloud("a.bin", bytes).points, (std::vector<Vec3>{{1, 2, 3}}));
}

// So many other files are called .bin that a folder's are passed over.
TEST(Kitti, IsNoFileOfAFolder) {
  EXPECT_FALSE(is_object_file("a.bin"));
}

TEST(Kitti, RefusesWhatIsAnotherFile) {
  EXPECT_EQ(problem_with("a.bin", "12345"),
            "is no scan of KITTI's kind (rows of four floats: x y z intensity): its 5 bytes are no multiple of 16");
  const std::string text = "this is a text of 32 characters.";
  EXPECT_TRUE(problem_with("a.bin", text)
                  .starts_with("is no scan of KITTI's kind (rows of four floats: x y z intensity): point 0 is at "));
  EXPECT_EQ(problem_with("a.bin", little_row<float>(1, 2, 3, 0, 1, 2, 3, 0), {.max_points = 1}),
            "holds more than 1 points; --max-points raises this limit");
}

TEST(Kitti, SurvivesDamage) {
  test::expect_survives_damage("a.bin", little_row<float>(1, 2, 3, 0.5, -4, 5, -6, 0));
}

}  // namespace
}  // namespace spincat
