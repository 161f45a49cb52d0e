#include "spincat/evaluate/rates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spincat/evaluate/roc.h"

namespace spincat {
namespace {

TEST(WilsonInterval, MatchesPublishedValues) {
  // R. G. Newcombe, Statistics in Medicine 17 (1998), table I, method 3.
  EXPECT_NEAR(wilson_interval(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilson_interval(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilson_interval(15, 148).low, 0.0624, 5e-5);
  EXPECT_NEAR(wilson_interval(15, 148).high, 0.1605, 5e-5);
  EXPECT_NEAR(wilson_interval(0, 20).low, 0.0, 5e-5);
  EXPECT_NEAR(wilson_interval(0, 20).high, 0.1611, 5e-5);
  EXPECT_NEAR(wilson_interval(1, 29).low, 0.0061, 5e-5);
  EXPECT_NEAR(wilson_interval(1, 29).high, 0.1718, 5e-5);
}

TEST(WilsonInterval, OfNothingIsEverything) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
  EXPECT_EQ(wilson_interval(7, 7).high, 1.0);
}

TEST(StudentT, MatchesPublishedTables) {
  EXPECT_NEAR(student_t_95(1), 12.706, 5e-4);
  EXPECT_NEAR(student_t_95(2), 4.303, 5e-4);
  EXPECT_NEAR(student_t_95(3), 3.182, 5e-4);
  EXPECT_NEAR(student_t_95(10), 2.228, 5e-4);
  EXPECT_NEAR(student_t_95(19), 2.093, 5e-4);
  EXPECT_NEAR(student_t_95(120), 1.980, 5e-4);
  EXPECT_NEAR(student_t_95(9999), 1.960, 5e-4);
}

const Confusion kConfusion = {{8, 2, 0}, {1, 1, 2}, {0, 0, 0}};

TEST(Rates, AreThoseOfTheConfusionMatrix) {
  EXPECT_DOUBLE_EQ(mean_class_rate(kConfusion), (0.8 + 0.25) / 2);  // the third category was not tested
  EXPECT_DOUBLE_EQ(overall_rate(kConfusion), 9.0 / 14.0);
  EXPECT_EQ(mean_class_rate({{0}}), 0.0);
  EXPECT_EQ(overall_rate({{0}}), 0.0);
}

TEST(PooledRates, OfOneCategoryAreWilsons) {
  const Confusion one = {{81, 182}, {0, 0}};
  const Interval wilson = wilson_interval(81, 263);
  for (const Rate& rate : {pooled_overall_rate(one), pooled_mean_class_rate(one)}) {
    EXPECT_DOUBLE_EQ(rate.mean, 81.0 / 263.0);
    EXPECT_NEAR(rate.interval.low, wilson.low, 1e-12);
    EXPECT_NEAR(rate.interval.high, wilson.high, 1e-12);
    EXPECT_EQ(rate.deviation, 0.0);
  }
}

TEST(PooledRates, AMeanOfTwoEqualCategoriesIsSurerThanEither) {
  // Two equal and independent shares: the distance of each bound from the mean falls by the root of two.
  const Rate rate = pooled_mean_class_rate({{15, 133}, {133, 15}});
  const Interval wilson = wilson_interval(15, 148);
  const double share = 15.0 / 148.0;
  EXPECT_NEAR(rate.interval.low, share - (share - wilson.low) / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(rate.interval.high, share + (wilson.high - share) / std::sqrt(2.0), 1e-12);
}

TEST(PooledRates, RightInEverythingIsStillUncertain) {
  const Rate rate = pooled_mean_class_rate({{8, 0}, {0, 9}});
  EXPECT_EQ(rate.mean, 1.0);
  EXPECT_EQ(rate.interval.high, 1.0);
  EXPECT_LT(rate.interval.low, 0.85);
}

TEST(RateOverSplits, IsTheCorrectedResampledInterval) {
  const std::vector<double> values = {0.4, 0.5, 0.6};  // deviation 0.1
  const Rate rate = rate_over_splits(values, 0.2);
  EXPECT_NEAR(rate.mean, 0.5, 1e-12);
  EXPECT_NEAR(rate.deviation, 0.1, 1e-12);
  const double half = 4.303 * 0.1 * std::sqrt(1.0 / 3.0 + 0.25);
  EXPECT_NEAR(rate.interval.low, 0.5 - half, 1e-4);
  EXPECT_NEAR(rate.interval.high, 0.5 + half, 1e-4);
}

TEST(RateOverSplits, OfOneSplitKnowsNothingOfItsSpread) {
  const Rate rate = rate_over_splits(std::vector{0.7}, 0.2);
  EXPECT_EQ(rate.mean, 0.7);
  EXPECT_EQ(rate.deviation, 0.0);
  EXPECT_EQ(rate.interval.low, 0.0);
  EXPECT_EQ(rate.interval.high, 1.0);
}

TEST(AreaUnderCurve, CountsWinsAndHalvesOfTies) {
  using V = std::vector<double>;
  EXPECT_EQ(area_under_curve(V{2, 3}, V{0, 1}), 1.0);
  EXPECT_EQ(area_under_curve(V{0, 1}, V{2, 3}), 0.0);
  EXPECT_EQ(area_under_curve(V{1, 1}, V{1}), 0.5);
  EXPECT_EQ(area_under_curve(V{1, 3}, V{0, 1, 2, 4}), (1.5 + 3.0) / 8.0);
  EXPECT_EQ(area_under_curve(V{}, V{1}), 0.5);
  EXPECT_EQ(area_under_curve(V{1}, V{}), 0.5);
}

}  // namespace
}  // namespace spincat
