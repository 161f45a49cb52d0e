#include "spincat/judge/gram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

FeatureMatrix random_features(Eigen::Index rows, Eigen::Index depth) {
  Random random(1);
  FeatureMatrix features(rows, depth);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index d = 0; d < depth; ++d) {
      features(i, d) = static_cast<float>(random.normal());
    }
    features.row(i).normalize();
  }
  return features;
}

class Gram : public testing::TestWithParam<std::tuple<Eigen::Index, Eigen::Index>> {};

TEST_P(Gram, IsAllInnerProducts) {
  const auto [rows, depth] = GetParam();
  const FeatureMatrix features = random_features(rows, depth);
  const Eigen::MatrixXf gram = gram_matrix(features, 1);
  ASSERT_EQ(gram.rows(), rows);
  ASSERT_EQ(gram.cols(), rows);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < rows; ++j) {
      double product = 0.0;
      for (Eigen::Index d = 0; d < depth; ++d) {
        product += static_cast<double>(features(i, d)) * static_cast<double>(features(j, d));
      }
      worst = std::max(worst, std::abs(gram(i, j) - product));
    }
  }
  EXPECT_LT(worst, 1e-6);  // 130 additions of numbers below 1 in single precision, typically 1e-7
}

TEST_P(Gram, IsSymmetricToTheLastBit) {
  const auto [rows, depth] = GetParam();
  const Eigen::MatrixXf gram = gram_matrix(random_features(rows, depth), 1);
  EXPECT_TRUE(gram == gram.transpose());
}

TEST_P(Gram, IsTheSameBytesForAnyNumberOfThreads) {
  const auto [rows, depth] = GetParam();
  const FeatureMatrix features = random_features(rows, depth);
  const Eigen::MatrixXf one = gram_matrix(features, 1);
  for (const int threads : {2, 3}) {
    const Eigen::MatrixXf several = gram_matrix(features, threads);
    EXPECT_EQ(std::memcmp(one.data(), several.data(), sizeof(float) * static_cast<std::size_t>(one.size())), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Ragged, Gram,
                         testing::Combine(testing::Values(1, 63, 64, 65, 130), testing::Values(1, 127, 129)));

TEST(Gram, OfNothingIsEmpty) {
  EXPECT_EQ(gram_matrix(FeatureMatrix(0, 5), 2).size(), 0);
}

}  // namespace
}  // namespace spincat
