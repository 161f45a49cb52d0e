#include "spincat/train/learned_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

// Rows of four categories in many features, of which only some tell them apart.
struct Rows {
  FeatureMatrix features;
  std::vector<std::uint32_t> labels;

  Rows(Eigen::Index count, Eigen::Index length) : features(count, length) {
    Random random(11);
    for (Eigen::Index i = 0; i < count; ++i) {
      labels.push_back(static_cast<std::uint32_t>(i % 4));
      for (Eigen::Index d = 0; d < length; ++d) {
        features(i, d) =
            static_cast<float>(random.normal() / (1.0 + 0.1 * static_cast<double>(d)) + (d == i % 4 ? 2.0 : 0.0));
      }
    }
  }

  std::vector<std::uint32_t> all() const {
    std::vector<std::uint32_t> rows(labels.size());
    std::iota(rows.begin(), rows.end(), 0U);
    return rows;
  }
};

float largest_difference(const LearnedSpace& a, const LearnedSpace& b) {
  return (a.places * a.places.transpose() - b.places * b.places.transpose()).cwiseAbs().maxCoeff();
}

TEST(LearnedSpace, IsTheSameByInnerProductsAndByFeatures) {
  const Rows data(60, 200);
  const GramMatrices gram = make_shared_gram(KernelKind::linear, {}, data.features, 1);
  const LearnedSpace by_products = learn_space(data.features, gram, data.labels, data.all(), 10);
  const LearnedSpace by_features = learn_space(data.features, {}, data.labels, data.all(), 10);
  EXPECT_FALSE(by_products.sample.empty());
  EXPECT_LT(largest_difference(by_products, by_features), 1e-3F);
  // With more dimensions than half the features, the features themselves are whitened.
  const LearnedSpace direct = learn_space(data.features, gram, data.labels, data.all(), 150);
  const LearnedSpace sampled = learn_space(data.features, gram, data.labels, data.all(), 140);
  EXPECT_TRUE(direct.sample.empty());
  EXPECT_FALSE(sampled.sample.empty());
  EXPECT_LT(largest_difference(direct, sampled), 0.02F);  // 59 directions at most: both have all of them
}

TEST(LearnedSpace, KnowsTheRowsItWasNotLearnedFromByItsMap) {
  const Rows data(80, 300);
  const GramMatrices gram = make_shared_gram(KernelKind::linear, {}, data.features, 1);
  std::vector<std::uint32_t> rows(40);
  std::iota(rows.begin(), rows.end(), 0U);
  const LearnedSpace space = learn_space(data.features, gram, data.labels, rows, 20);
  const Whitening whitening(space.whitening(data.features));
  ASSERT_EQ(whitening.length(), 20U);
  ASSERT_EQ(whitening.input_length(), 300U);
  for (Eigen::Index i = 0; i < 80; ++i) {
    const std::vector<float> place = whitening.place({data.features.row(i).data(), 300});
    for (Eigen::Index d = 0; d < 20; ++d) {
      EXPECT_NEAR(place[static_cast<std::size_t>(d)], space.places(i, d), 2e-3F) << i;
    }
  }
}

// The trap of learning a space from what is tested.
TEST(LearnedSpace, DoesNotLookAtOtherRows) {
  Rows data(80, 300);
  std::vector<std::uint32_t> rows(40);
  std::iota(rows.begin(), rows.end(), 0U);
  const auto learned = [&] {
    const GramMatrices gram = make_shared_gram(KernelKind::linear, {}, data.features, 1);
    return learn_space(data.features, gram, data.labels, rows, 20);
  };
  const LearnedSpace before = learned();
  data.features.bottomRows(40) *= -3.0F;
  data.labels[60] = 0;
  const LearnedSpace after = learned();
  EXPECT_EQ(after.axes, before.axes);
  EXPECT_EQ(after.middle, before.middle);
  EXPECT_EQ(after.places.topRows(40), before.places.topRows(40));
}

}  // namespace
}  // namespace spincat
