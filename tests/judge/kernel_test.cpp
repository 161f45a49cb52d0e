#include "spincat/judge/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

const std::vector<std::uint32_t> kBlocks = {3, 1, 6};

FeatureMatrix random_features(Eigen::Index rows) {
  Random random(5);
  FeatureMatrix features(rows, 10);
  for (Eigen::Index i = 0; i < features.size(); ++i) {
    features.data()[i] = static_cast<float>(random.normal());
  }
  return features;
}

std::vector<std::uint32_t> first_rows(std::uint32_t count) {
  std::vector<std::uint32_t> rows(count);
  std::iota(rows.begin(), rows.end(), 0U);
  return rows;
}

// By the definition, one pair of rows after the other.
double squared_distance(const FeatureMatrix& features, std::uint32_t i, std::uint32_t j, Eigen::Index first,
                        Eigen::Index count) {
  double sum = 0.0;
  for (Eigen::Index d = first; d < first + count; ++d) {
    const double difference = static_cast<double>(features(i, d)) - static_cast<double>(features(j, d));
    sum += difference * difference;
  }
  return sum;
}

double rbf(const Kernel& kernel, const FeatureMatrix& features, std::uint32_t i, std::uint32_t j) {
  double sum = 0.0;
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < kBlocks.size(); ++b) {
    sum += std::exp(-squared_distance(features, i, j, first, kBlocks[b]) / static_cast<double>(kernel.scale[b]));
    first += kBlocks[b];
  }
  return sum / static_cast<double>(kBlocks.size());
}

TEST(FitKernel, ScalesAreMeanSquaredDistancesOfTheGivenRows) {
  const FeatureMatrix features = random_features(9);
  const std::vector<std::uint32_t> rows = {1, 2, 4, 7};
  const Kernel kernel = fit_kernel(KernelKind::rbf, kBlocks, features, rows);
  ASSERT_EQ(kernel.block_sizes, kBlocks);
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < kBlocks.size(); ++b) {
    double sum = 0.0;
    for (const std::uint32_t i : rows) {
      for (const std::uint32_t j : rows) {
        sum += squared_distance(features, i, j, first, kBlocks[b]);
      }
    }
    EXPECT_NEAR(kernel.scale[b], sum / 16.0, 1e-5);
    first += kBlocks[b];
  }
}

TEST(FitKernel, RowsThatAreNotGivenDoNotMatter) {
  FeatureMatrix features = random_features(9);
  const std::vector<std::uint32_t> rows = {1, 2, 4, 7};
  const Kernel before = fit_kernel(KernelKind::rbf, kBlocks, features, rows);
  features.row(3).setConstant(100.0F);
  EXPECT_EQ(fit_kernel(KernelKind::rbf, kBlocks, features, rows).scale, before.scale);
}

TEST(KernelMatrix, IsTheDefinition) {
  const FeatureMatrix features = random_features(9);
  const std::vector<std::uint32_t> rows = {7, 1, 2, 4};
  const Kernel kernel = fit_kernel(KernelKind::rbf, kBlocks, features, first_rows(9));
  const GramMatrices gram = make_shared_gram(KernelKind::rbf, kBlocks, features, 1);
  ASSERT_EQ(gram.blocks.size(), 3U);
  for (const GramMatrices& shared : {gram, GramMatrices{}}) {
    const Eigen::MatrixXf found = kernel_matrix(kernel, features, shared, rows);
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        EXPECT_NEAR(found(i, j), rbf(kernel, features, rows[i], rows[j]), 1e-5);
      }
      EXPECT_FLOAT_EQ(found(i, i), 1.0F);
    }
  }
}

TEST(KernelMatrix, IsTheGramMatrixWhenLinear) {
  const FeatureMatrix features = random_features(9);
  const std::vector<std::uint32_t> rows = {7, 1};
  const GramMatrices gram = make_shared_gram(KernelKind::linear, kBlocks, features, 1);
  ASSERT_EQ(gram.blocks.size(), 1U);
  const Eigen::MatrixXf found = kernel_matrix({}, features, gram, rows);
  EXPECT_NEAR(found(0, 1), features.row(7).dot(features.row(1)), 1e-5);
  EXPECT_LT((found - kernel_matrix({}, features, {}, rows)).cwiseAbs().maxCoeff(), 1e-5F);
}

TEST(KernelRow, IsARowOfTheMatrix) {
  const FeatureMatrix features = random_features(9);
  for (const KernelKind kind : {KernelKind::linear, KernelKind::rbf}) {
    const Kernel kernel = fit_kernel(kind, kBlocks, features, first_rows(9));
    const Eigen::MatrixXf matrix = kernel_matrix(kernel, features, {}, first_rows(9));
    const Eigen::VectorXf row = kernel.row(features, {features.row(4).data(), 10});
    EXPECT_LT((row - matrix.col(4)).cwiseAbs().maxCoeff(), 1e-5F);
  }
}

TEST(Kernel, ABlockThatNeverDiffersSaysNothing) {
  FeatureMatrix features = random_features(9);
  features.col(3).setConstant(0.25F);
  const Kernel kernel = fit_kernel(KernelKind::rbf, kBlocks, features, first_rows(9));
  EXPECT_EQ(kernel.scale[1], 0.0F);
  const Eigen::VectorXf row = kernel.row(features, std::vector<float>(10, 1000.0F));
  EXPECT_TRUE(row.allFinite());
  EXPECT_NEAR(row[0], 1.0F / 3.0F, 1e-6F);  // of the three blocks only that one
}

}  // namespace
}  // namespace spincat
