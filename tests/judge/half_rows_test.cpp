#include "spincat/judge/half_rows.h"

#include <gtest/gtest.h>

#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

FeatureMatrix random_matrix(Eigen::Index rows, Eigen::Index columns) {
  Random random(6);
  FeatureMatrix matrix(rows, columns);
  for (float& value : matrix.reshaped()) {
    value = static_cast<float>(random.normal());
  }
  return matrix;
}

std::vector<float> weights_with_zeros(std::size_t count) {
  Random random(7);
  std::vector<float> weights;
  for (std::size_t i = 0; i < count; ++i) {
    weights.push_back(i % 3 == 1 ? 0.0F : static_cast<float>(random.normal()));
  }
  return weights;
}

class HalfRowsOf : public testing::TestWithParam<int> {};

TEST_P(HalfRowsOf, SumUpAsRoundedNumbersDo) {
  const FeatureMatrix matrix = random_matrix(GetParam(), 50);
  const HalfRows rows(matrix);
  ASSERT_EQ(rows.rows(), 50U);
  ASSERT_EQ(rows.columns(), static_cast<std::size_t>(GetParam()));
  const std::vector<float> weights = weights_with_zeros(50);
  const std::vector<float> sums = rows.weighted_sum(weights);
  for (Eigen::Index c = 0; c < matrix.rows(); ++c) {
    float expected = 0.0F;  // in the same order, without fused operations: the same to the last bit
    for (Eigen::Index r = 0; r < 50; ++r) {
      expected += weights[static_cast<std::size_t>(r)] * static_cast<float>(Eigen::half(matrix(c, r)));
    }
    EXPECT_EQ(sums[static_cast<std::size_t>(c)], expected) << c;
  }
}

TEST_P(HalfRowsOf, GiveTheProductOfEachRow) {
  const FeatureMatrix matrix = random_matrix(GetParam(), 20);
  const HalfRows rows(matrix);
  const std::vector<float> weights = weights_with_zeros(rows.columns());
  const std::vector<float> products = rows.products(weights);
  for (Eigen::Index r = 0; r < 20; ++r) {
    double expected = 0.0;
    for (Eigen::Index c = 0; c < matrix.rows(); ++c) {
      expected +=
          static_cast<double>(weights[static_cast<std::size_t>(c)]) * static_cast<double>(Eigen::half(matrix(c, r)));
    }
    EXPECT_NEAR(products[static_cast<std::size_t>(r)], expected, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, HalfRowsOf, testing::Values(1, 5, 16, 37, 200));

TEST(HalfRows, KnowWhatIsNotFinite) {
  EXPECT_TRUE(HalfRows(2, {0x3C00, 0x7BFF, 0xFBFF, 0x0001}).all_finite());
  for (const std::uint16_t bad : {std::uint16_t{0x7C00}, std::uint16_t{0xFC00}, std::uint16_t{0x7E00}}) {
    EXPECT_FALSE(HalfRows(2, {0x3C00, 0, 0, bad}).all_finite()) << bad;
  }
}

TEST(HalfRows, KeepTheBitsOfAFile) {
  const HalfRows rows(random_matrix(3, 4));
  const HalfRows again(4, {rows.bits().begin(), rows.bits().end()});
  const std::vector<float> weights = {1, 2, 3, 4};
  EXPECT_EQ(again.weighted_sum(weights), rows.weighted_sum(weights));
}

}  // namespace
}  // namespace spincat
