#include "spincat/judge/judge_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "spincat/geometry/random.h"
#include "spincat/judge/pairwise_svm.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

constexpr double kSolved = 2e-3;  // libsvm stops at 1e-3

FeatureMatrix column(const std::vector<float>& x) {
  return Eigen::Map<const FeatureMatrix>(x.data(), static_cast<Eigen::Index>(x.size()), 1);
}

// The line w x + b of a machine on one-dimensional points.
std::pair<double, double> line_of(const std::vector<float>& x, std::uint32_t first_count, double c_first,
                                  double c_second) {
  const PairwiseSvm svm = train_pairwise_svm(gram_matrix(column(x), 1), first_count, c_first, c_second);
  double w = 0.0;
  for (std::size_t s = 0; s < svm.object.size(); ++s) {
    w += svm.coefficient[s] * static_cast<double>(x[svm.object[s]]);
  }
  return {w, svm.bias};
}

TEST(PairwiseSvm, FindsTheWidestMarginOnALine) {
  // Between 3 and -1: f is 1 at 3 and -1 at -1.
  const auto [w, b] = line_of({5, 3, 8, -1, -4}, 3, 100, 100);
  EXPECT_NEAR(w, 0.5, kSolved);
  EXPECT_NEAR(b, -0.5, kSolved);
}

TEST(PairwiseSvm, LeansOnTheObjectsAtTheMarginAlone) {
  const PairwiseSvm svm = train_pairwise_svm(gram_matrix(column({5, 3, 8, -1, -4}), 1), 3, 100, 100);
  EXPECT_EQ(svm.object, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_NEAR(svm.coefficient[0], 0.125, kSolved);
  EXPECT_NEAR(svm.coefficient[1], -0.125, kSolved);
}

TEST(PairwiseSvm, SwappingTheCategoriesFlipsTheSign) {
  const auto [w, b] = line_of({-1, -4, 5, 3, 8}, 2, 100, 100);
  EXPECT_NEAR(w, -0.5, kSolved);
  EXPECT_NEAR(b, 0.5, kSolved);
}

TEST(PairwiseSvm, TheCheaperSideGivesWay) {
  // 1 is claimed by both sides, three times by the second.
  const std::vector<float> x = {1, 1, 1, 1, -1};
  const auto [w, b] = line_of(x, 1, 1000, 100);
  EXPECT_NEAR(w + b, 1.0, kSolved);
  const auto [v, a] = line_of(x, 1, 100, 100);
  EXPECT_NEAR(v + a, -1.0, kSolved);
}

TEST(AllPairs, AreInTheOrderOfTheJudges) {
  const std::vector<CategoryPair> pairs = all_pairs(4);
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> expected = {{0, 1}, {0, 2}, {0, 3},
                                                                         {1, 2}, {1, 3}, {2, 3}};
  ASSERT_EQ(pairs.size(), 6U);
  for (std::size_t l = 0; l < 6; ++l) {
    EXPECT_EQ(std::pair(pairs[l].a, pairs[l].b), expected[l]);
  }
}

// Trains the only judge of two categories on one-dimensional points.
Judge train(const std::vector<float>& x, const std::vector<std::uint32_t>& labels, const JudgeSettings& settings) {
  const FeatureMatrix features = column(x);
  const GramMatrices gram = make_shared_gram(KernelKind::linear, {}, features, 1);
  std::vector<std::uint32_t> rows(x.size());
  std::iota(rows.begin(), rows.end(), 0U);
  return TrainingSet(features, gram, {}, labels, rows, 2).train({0, 1}, settings);
}

// Of the line that the judge folds into.
double weight(const Judge& judge, const std::vector<float>& x) {
  double w = 0.0;
  for (std::size_t s = 0; s < judge.rows.size(); ++s) {
    w += judge.coefficients[s] * static_cast<double>(x[judge.rows[s]]);
  }
  return w;
}

TEST(TrainingSet, ClassWeightsKeepALargeCategoryFromOutvotingASmallOne) {
  // At 1 lie two objects of the small category and ten of the large one, which has ten more at -1. Counted, the large
  // category wins there; weighed, the small one does, all of it being there.
  std::vector<float> x(22, 1.0F);
  std::vector<std::uint32_t> labels(22, 1);
  labels[4] = labels[17] = 0;
  for (std::size_t i = 0, moved = 0; moved < 10; ++i) {
    if (labels[i] == 1) {
      x[i] = -1.0F;
      ++moved;
    }
  }
  const Judge weighed = train(x, labels, {.c = 200.0});
  EXPECT_NEAR(weight(weighed, x), 1.0, kSolved);
  EXPECT_NEAR(weighed.bias, 0.0, kSolved);
  const Judge counted = train(x, labels, {.c = 200.0, .class_weights = false});
  EXPECT_NEAR(weight(counted, x) + counted.bias, -1.0, kSolved);
  EXPECT_NEAR(-weight(counted, x) + counted.bias, -1.0, kSolved);
}

TEST(TrainingSet, PricesAreCTimesAllObjectsByThoseOfTheCategory) {
  // Both at one place: the multipliers reach the smaller price. Three objects, two categories: 3/2 and 3/4 of C.
  const Judge judge = train({1, 1, 1}, {0, 1, 1}, {.c = 4.0});
  EXPECT_EQ(judge.rows.size(), 3U);
  // Balanced, the two sides pull equally, at twice C 3/4: the weight is 1 * 6 - 1 * 6.
  EXPECT_NEAR(weight(judge, {1, 1, 1}), 0.0, kSolved);
}

const std::vector<std::uint32_t> kBlocks = {2, 5, 1};

// Three noisy clouds in eight dimensions, rows of the categories mixed.
struct ThreeClouds {
  FeatureMatrix features = FeatureMatrix(45, 8);
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> rows;  // those to learn from: two in three
  GramMatrices gram;

  ThreeClouds() {
    Random random(1);
    for (std::uint32_t i = 0; i < 45; ++i) {
      labels.push_back(i * 7 % 3);
      for (Eigen::Index d = 0; d < 8; ++d) {
        features(i, d) = static_cast<float>(0.4 * random.normal() + (d == labels[i] ? 1.0 : 0.0));
      }
      if (i % 9 < 6) {
        rows.push_back(i);
      }
    }
    gram = make_shared_gram(KernelKind::linear, kBlocks, features, 1);
  }

  JudgeList judges(const GramMatrices& shared_gram, KernelKind kind = KernelKind::linear) const {
    const TrainingSet training(features, shared_gram, fit_kernel(kind, kBlocks, features, rows), labels, rows, 3);
    std::vector<Judge> trained;
    for (const CategoryPair pair : all_pairs(3)) {
      trained.push_back(training.train(pair, {.kernel = kind, .c = default_c({.kernel = kind})}));
    }
    return training.list(trained);
  }
};

// Margins from the shared inner products are those of the finished list.
TEST(TrainingSet, TellsMarginsWithoutFolding) {
  for (const KernelKind kind : {KernelKind::linear, KernelKind::rbf}) {
    const ThreeClouds clouds;
    const GramMatrices gram = make_shared_gram(kind, kBlocks, clouds.features, 1);
    const TrainingSet training(clouds.features, gram, fit_kernel(kind, kBlocks, clouds.features, clouds.rows),
                               clouds.labels, clouds.rows, 3);
    std::vector<Judge> trained;
    for (const CategoryPair pair : all_pairs(3)) {
      trained.push_back(training.train(pair, {.kernel = kind, .c = default_c({.kernel = kind})}));
    }
    const std::vector<std::uint32_t> rows = {44, 0, 7};
    std::vector<std::span<const float>> objects;
    for (const std::uint32_t row : rows) {
      objects.emplace_back(clouds.features.row(row).data(), 8);
    }
    const FeatureMatrix margins = training.margins(trained, rows);
    const FeatureMatrix expected = training.list(trained).margins(objects);
    ASSERT_EQ(margins.rows(), 3);
    ASSERT_EQ(margins.cols(), 3);
    EXPECT_LT((margins - expected).cwiseAbs().maxCoeff(), 1e-4F * (1.0F + expected.cwiseAbs().maxCoeff()));
    EXPECT_EQ(training.margins(std::span(trained).subspan(1, 1), rows), margins.col(1));
  }
}

// Linear judges then learn from the rows: the same but for the price of the bias.
TEST(TrainingSet, NeedsNoSharedGramMatrix) {
  const ThreeClouds clouds;
  const JudgeList shared = clouds.judges(clouds.gram);
  const JudgeList own = clouds.judges({});
  for (Eigen::Index l = 0; l < shared.weights.rows(); ++l) {
    const float cosine = shared.weights.row(l).normalized().dot(own.weights.row(l).normalized());
    EXPECT_GT(cosine, 0.95F);
    EXPECT_NEAR(shared.bias[l], own.bias[l], 0.2F);
  }
}

TEST(TrainingSet, IsRepeatable) {
  const ThreeClouds clouds;
  EXPECT_EQ(clouds.judges(clouds.gram).weights, clouds.judges(clouds.gram).weights);
}

TEST(JudgeList, VotesAsTheSupportVectorsDo) {
  const ThreeClouds clouds;
  const JudgeList judges = clouds.judges(clouds.gram);
  ASSERT_EQ(judges.size(), 3U);
  ASSERT_EQ(judges.categories, 3U);
  const std::vector<CategoryPair> pairs = all_pairs(3);
  for (std::size_t l = 0; l < pairs.size(); ++l) {
    // The same machine from its parts: rows of the first category, then of the second, prices by the definition.
    std::vector<std::uint32_t> rows;
    std::uint32_t first_count = 0;
    double counts[2] = {0.0, 0.0};
    for (const std::uint32_t category : {pairs[l].a, pairs[l].b}) {
      for (const std::uint32_t row : clouds.rows) {
        if (clouds.labels[row] == category) {
          rows.push_back(row);
          first_count += category == pairs[l].a ? 1 : 0;
          counts[category == pairs[l].a ? 0 : 1] += 1.0;
        }
      }
    }
    const auto all = static_cast<double>(clouds.rows.size());
    const PairwiseSvm svm = train_pairwise_svm(clouds.gram.blocks[0](rows, rows), first_count,
                                               200.0 * all / (3.0 * counts[0]), 200.0 * all / (3.0 * counts[1]));
    EXPECT_EQ(judges.support_vectors[l], svm.object.size());
    for (std::uint32_t i = 0; i < 45; ++i) {
      double margin = svm.bias;
      for (std::size_t s = 0; s < svm.object.size(); ++s) {
        margin += svm.coefficient[s] * static_cast<double>(clouds.gram.blocks[0](rows[svm.object[s]], i));
      }
      const Ballot ballot = judges.vote({clouds.features.row(i).data(), 8});
      EXPECT_NEAR(ballot.votes[l].margin, margin, 1e-3 * (1.0 + std::abs(margin)));
    }
  }
}

TEST(JudgeList, RbfVotesAsTheSupportVectorsDo) {
  const ThreeClouds clouds;
  const GramMatrices gram = make_shared_gram(KernelKind::rbf, kBlocks, clouds.features, 1);
  const JudgeList judges = clouds.judges(gram, KernelKind::rbf);
  const Kernel kernel = fit_kernel(KernelKind::rbf, kBlocks, clouds.features, clouds.rows);
  const TrainingSet training(clouds.features, gram, kernel, clouds.labels, clouds.rows, 3);
  const std::vector<CategoryPair> pairs = all_pairs(3);
  EXPECT_EQ(judges.feature_length(), 8U);
  EXPECT_LE(judges.supports.rows(), 30);  // each training object once, however many judges lean on it
  for (std::size_t l = 0; l < pairs.size(); ++l) {
    const Judge judge = training.train(pairs[l], {.kernel = KernelKind::rbf, .c = 3.0});
    ASSERT_EQ(judge.rows.size(), judges.support_vectors[l]);
    for (std::uint32_t i = 0; i < 45; ++i) {
      double margin = judge.bias;
      for (std::size_t s = 0; s < judge.rows.size(); ++s) {
        const std::vector<std::uint32_t> two = {judge.rows[s], i};
        const Eigen::MatrixXf k = kernel_matrix(kernel, clouds.features, {}, two);
        margin += judge.coefficients[s] * static_cast<double>(k(0, 1));
      }
      const Ballot ballot = judges.vote({clouds.features.row(i).data(), 8});
      EXPECT_NEAR(ballot.votes[l].margin, margin, 1e-4 * (1.0 + std::abs(margin)));
    }
  }
}

TEST(JudgeList, RbfTellsARingFromItsMiddle) {
  // No line parts them: a linear judge is wrong on some, whatever its C.
  FeatureMatrix features(24, 2);
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> rows(24);
  std::iota(rows.begin(), rows.end(), 0U);
  for (Eigen::Index i = 0; i < 24; ++i) {
    const float radius = i % 2 == 0 ? 2.0F : 0.5F;
    features.row(i) << radius * std::cos(static_cast<float>(i)), radius * std::sin(static_cast<float>(i));
    labels.push_back(static_cast<std::uint32_t>(i % 2));
  }
  const auto right = [&](KernelKind kind) {
    const GramMatrices none;
    const TrainingSet training(features, none, fit_kernel(kind, std::vector<std::uint32_t>{2}, features, rows), labels,
                               rows, 2);
    const JudgeList judges = training.list(std::vector<Judge>{training.train({0, 1}, {.kernel = kind, .c = 200.0})});
    int count = 0;
    for (const std::uint32_t row : rows) {
      count += judges.vote({features.row(row).data(), 2}).winner == labels[row] ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(right(KernelKind::rbf), 24);
  EXPECT_LT(right(KernelKind::linear), 24);
}

TEST(JudgeList, NamesWhatItLearntFrom) {
  const ThreeClouds clouds;
  const JudgeList judges = clouds.judges(clouds.gram);
  int right = 0;
  for (const std::uint32_t row : clouds.rows) {
    right += judges.vote({clouds.features.row(row).data(), 8}).winner == clouds.labels[row] ? 1 : 0;
  }
  EXPECT_GE(right, 28);  // of 30
}

TEST(JudgeSettings, AreRefusedOutOfRange) {
  const auto error = [](double c) { return test::input_error([&] { JudgeSettings{.c = c}.validate(); }); };
  EXPECT_EQ(error(0.0), "c 0: expected a number above 0");
  EXPECT_EQ(error(-1.0), "c -1: expected a number above 0");
  EXPECT_EQ(error(std::numeric_limits<double>::infinity()), "c inf: expected a number above 0");
  EXPECT_EQ(error(std::numeric_limits<double>::quiet_NaN()), "c nan: expected a number above 0");
  EXPECT_EQ(error(1e-9), "no error");
}

}  // namespace
}  // namespace spincat
