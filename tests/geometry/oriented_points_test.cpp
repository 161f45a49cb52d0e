#include "spincat/geometry/oriented_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace spincat {
namespace {

std::array<std::span<const float>, 6> arrays_of(const OrientedPoints& points) {
  return {points.x(), points.y(), points.z(), points.nx(), points.ny(), points.nz()};
}

TEST(OrientedPoints, NoPointsAreEmpty) {
  const OrientedPoints points;
  EXPECT_TRUE(points.empty());
  EXPECT_EQ(points.size(), 0U);
  for (const auto array : arrays_of(points)) {
    EXPECT_TRUE(array.empty());
  }
}

TEST(OrientedPoints, EachComponentHasItsArray) {
  OrientedPoints points(17);
  points.set(16, {1, 2, 3}, {4, 5, 6});
  float expected = 1.0F;
  for (const auto array : arrays_of(points)) {
    EXPECT_EQ(array.size(), 17U);
    EXPECT_EQ(array[16], expected++);
    EXPECT_EQ(array[15], 0.0F);
  }
  EXPECT_EQ(points.position(16), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(points.normal(16), Eigen::Vector3f(4, 5, 6));
}

class OrientedPointsOfSize : public testing::TestWithParam<std::size_t> {};

TEST_P(OrientedPointsOfSize, EveryArrayStartsOnACacheLineAndIsPaddedWithZeros) {
  const std::size_t size = GetParam();
  OrientedPoints points(size);
  for (std::size_t i = 0; i < size; ++i) {
    points.set(i, {1, 1, 1}, {1, 1, 1});
  }
  for (const auto array : arrays_of(points)) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0U);
    for (std::size_t i = 0; i < size; ++i) {
      EXPECT_EQ(array[i], 1.0F);
    }
    for (std::size_t i = size; i < (size + 15) / 16 * 16; ++i) {
      EXPECT_EQ(array.data()[i], 0.0F) << "padding " << i << " of " << size;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ragged, OrientedPointsOfSize, testing::Values(1, 15, 16, 17, 100));

}  // namespace
}  // namespace spincat
