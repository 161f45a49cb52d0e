#include "spincat/judge/known_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

// Known rows lie about one place, the background about another.
struct Rows {
  FeatureMatrix features;
  std::vector<std::uint32_t> known;
  std::vector<std::uint32_t> background;

  Rows(std::uint32_t known_count, std::uint32_t background_count) : features(known_count + background_count, 5) {
    Random random(4);
    for (std::uint32_t i = 0; i < known_count + background_count; ++i) {
      (i < known_count ? known : background).push_back(i);
      for (Eigen::Index d = 0; d < 5; ++d) {
        const double place = d == 0 ? (i < known_count ? 0.8 : -0.8) : 0.0;
        features(i, d) = static_cast<float>(place + 0.3 * random.normal());
      }
    }
  }

  std::vector<double> margins(const KnownJudge& judge, std::span<const std::uint32_t> rows) const {
    std::vector<double> result;
    for (const std::uint32_t row : rows) {
      result.push_back(static_cast<double>(judge.margin({features.row(row).data(), 5})));
    }
    return result;
  }
};

TEST(KnownJudge, TellsKnownRowsFromTheBackground) {
  const Rows rows(60, 40);
  const KnownJudge judge = train_known_judge(rows.features, rows.known, rows.background);
  for (const double margin : rows.margins(judge, rows.known)) {
    EXPECT_GT(margin, 0.0);
  }
  for (const double margin : rows.margins(judge, rows.background)) {
    EXPECT_LT(margin, 0.0);
  }
}

TEST(KnownJudge, OfManyRowsLearnsFromSomeOfAll) {
  const Rows rows(4000, 30);
  const KnownJudge judge = train_known_judge(rows.features, rows.known, rows.background);
  std::size_t right = 0;
  for (const double margin : rows.margins(judge, rows.known)) {
    right += margin > 0.0 ? 1 : 0;
  }
  EXPECT_GT(right, 3900U);
  // What lies at the end of the rows counts, too.
  Rows moved = rows;
  moved.features.middleRows(2000, 2000).rowwise() += Eigen::RowVectorXf::Unit(5, 1) * 5.0F;
  EXPECT_NE(train_known_judge(moved.features, moved.known, moved.background).weights, judge.weights);
}

// Two categories of two objects each, at right angles; a row of the background lies with the first.
TEST(UnlikeKnown, LeavesOutWhatLooksLikeACategory) {
  FeatureMatrix rows(7, 3);
  rows << 1, 0, 0,                                                      //
      0.99F, 0.141F, 0, 0, 1, 0, 0, 0.99F, 0.141F, 0.995F, 0.0999F, 0,  // like the first category
      0, 0, 1, 0.707F, 0.707F, 0;                                       // like none
  const std::vector<std::uint32_t> known = {0, 1, 2, 3};
  const std::vector<RowOrigin> origins = {{0, 0}, {0, 1}, {1, 2}, {1, 3}};
  const std::vector<std::uint32_t> background = {4, 5, 6};
  EXPECT_EQ(unlike_known(rows, known, origins, background), (std::vector<std::uint32_t>{5, 6}));
  // Copies of one object tell nothing of how like objects of a category are.
  const std::vector<RowOrigin> alone = {{0, 0}, {0, 0}, {1, 1}, {1, 1}};
  EXPECT_EQ(unlike_known(rows, known, alone, background), background);
}

TEST(KnownJudge, WithoutWeightsKnowsEverything) {
  const std::vector<float> anything = {1, 2, 3};
  EXPECT_TRUE(KnownJudge{}.empty());
  EXPECT_EQ(KnownJudge{}.known(anything), 1.0);
  EXPECT_EQ(KnownJudge{}.least, 0.0);
}

TEST(CalibrateKnown, TurnsAwayThreeInAHundredKnownObjects) {
  std::vector<double> known(500);
  std::vector<double> strangers(100);
  for (std::size_t i = 0; i < known.size(); ++i) {
    known[i] = -0.5 + 0.01 * static_cast<double>(i * 7 % 500);
  }
  for (std::size_t i = 0; i < strangers.size(); ++i) {
    strangers[i] = -3.0 + 0.03 * static_cast<double>(i);
  }
  KnownJudge judge;
  calibrate_known(known, strangers, judge);
  const auto below = std::ranges::count_if(known, [&](double m) { return judge.scaling.probability(m) < judge.least; });
  EXPECT_EQ(below, 15);
  EXPECT_GT(judge.scaling.slope, 0.0);
}

// Fifty strangers and five hundred known objects of the same margins: neither is likelier.
TEST(CalibrateKnown, WeighsBothSidesAlike) {
  std::vector<double> known;
  std::vector<double> strangers;
  for (int i = 0; i < 500; ++i) {
    known.push_back(0.01 * i);
    if (i % 10 == 5) {
      strangers.push_back(0.01 * i);
    }
  }
  KnownJudge judge;
  calibrate_known(known, strangers, judge);
  EXPECT_NEAR(judge.scaling.probability(2.5), 0.5, 0.02);
}

TEST(CalibrateKnown, ChangesNothingWithAHandfulOfMargins) {
  KnownJudge judge;
  calibrate_known(std::vector<double>(9, 1.0), std::vector<double>(50, -1.0), judge);
  EXPECT_EQ(judge.scaling.slope, PlattScaling{}.slope);
  EXPECT_EQ(judge.least, 0.0);
}

}  // namespace
}  // namespace spincat
