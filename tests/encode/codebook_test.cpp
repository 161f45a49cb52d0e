#include "spincat/encode/codebook.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void fill(Rows& rows, Random& random) {
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    rows.data()[i] = static_cast<float>(random.normal());
  }
}

// `each` points close around every one of three far-apart places in five dimensions.
Rows three_heaps(Eigen::Index each) {
  Random random(3);
  Rows samples(3 * each, 5);
  for (Eigen::Index i = 0; i < samples.rows(); ++i) {
    for (Eigen::Index d = 0; d < 5; ++d) {
      samples(i, d) = static_cast<float>(0.01 * random.normal() + (d == i % 3 ? 10.0 : 0.0));
    }
  }
  return samples;
}

TEST(LearnCodebook, FindsTheHeaps) {
  const Rows samples = three_heaps(50);
  const Codebook codebook = learn_codebook(samples, 3, 1, 1);
  ASSERT_EQ(codebook.words.rows(), 3);
  for (Eigen::Index heap = 0; heap < 3; ++heap) {
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(5);
    for (Eigen::Index i = heap; i < samples.rows(); i += 3) {
      mean += samples.row(i).cast<double>() / 50.0;
    }
    EXPECT_LT((codebook.words.cast<double>().rowwise() - mean).rowwise().norm().minCoeff(), 1e-5);
  }
}

TEST(LearnCodebook, DependsOnTheSeedAndNotOnThreads) {
  const Rows samples = three_heaps(200);
  const Codebook one = learn_codebook(samples, 17, 5, 1);
  EXPECT_TRUE(one.words == learn_codebook(samples, 17, 5, 3).words);
  EXPECT_FALSE(one.words == learn_codebook(samples, 17, 6, 1).words);
  EXPECT_TRUE(one.words.allFinite());
}

TEST(LearnCodebook, FewSamplesAreTheWordsThemselves) {
  const Rows samples = three_heaps(2);
  EXPECT_TRUE(learn_codebook(samples, 6, 1, 1).words == samples);
  EXPECT_TRUE(learn_codebook(samples, 50, 1, 1).words == samples);
}

TEST(LearnCodebook, EqualSamplesAreNoTrouble) {
  const Codebook codebook = learn_codebook(Rows::Ones(40, 3), 4, 1, 2);
  EXPECT_TRUE(codebook.words == Rows::Ones(4, 3));
}

TEST(Codebook, CountsTheNearestWord) {
  Random random(9);
  Codebook codebook;
  codebook.words.resize(130, 4);  // more than one tile
  fill(codebook.words, random);
  Rows local(90, 4);
  fill(local, random);
  std::vector<double> shares(130, 0.0);
  for (Eigen::Index i = 0; i < 90; ++i) {
    Eigen::Index nearest = 0;
    (codebook.words.rowwise() - local.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    shares[static_cast<std::size_t>(nearest)] += 1.0 / 90.0;
  }
  const std::vector<float> found = codebook.count({local.data(), 360});
  ASSERT_EQ(found.size(), 130U);
  for (std::size_t w = 0; w < 130; ++w) {
    EXPECT_NEAR(found[w], std::sqrt(shares[w]), 1e-6);
  }
}

TEST(Codebook, KnowsItsInput) {
  EXPECT_TRUE(Codebook{}.empty());
  const Codebook codebook{Rows::Ones(7, 3)};
  EXPECT_FALSE(codebook.empty());
  EXPECT_EQ(codebook.input_length(), 3U * kLocalFeatures);
  EXPECT_EQ(codebook.count(std::vector<float>(9, 0.5F))[0], 1.0F);  // all equally near: the first
}

}  // namespace
}  // namespace spincat
