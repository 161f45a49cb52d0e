#include "spincat/judge/platt_scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace spincat {
namespace {

double logistic(double t) {
  return 1.0 / (1.0 + std::exp(-t));
}

double confidence_at(const PlattScaling& scaling, double margin) {
  return scaling.probability(margin);
}

// A thousand votes at each of 41 margins from -unit to 2 unit, right as often as the logistic function says.
std::vector<Scored> votes_by(double slope, double offset, double unit) {
  std::vector<Scored> votes;
  for (int k = 0; k <= 40; ++k) {
    const double margin = unit * (-1.0 + 3.0 * k / 40.0);
    const long right = std::lround(1000.0 * logistic(slope * margin + offset));
    for (int i = 0; i < 1000; ++i) {
      votes.push_back({margin, i < right});
    }
  }
  return votes;
}

TEST(PlattScaling, IsTheLogisticFunction) {
  EXPECT_DOUBLE_EQ(confidence_at({2.0, 0.0}, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(confidence_at({2.0, 0.5}, 1.0), logistic(2.5));
  for (const double margin : {-1e30, 1e30}) {
    EXPECT_GT(confidence_at({2.0, 0.0}, margin), 0.0);
    EXPECT_LT(confidence_at({2.0, 0.0}, margin), 1.0);
  }
}

class PlattUnit : public testing::TestWithParam<double> {};

TEST_P(PlattUnit, RecoversALogisticFunction) {
  const double unit = GetParam();  // of the margins
  for (const auto& [slope, offset] : {std::pair(4.0, -1.0), std::pair(0.7, 0.5), std::pair(2.0, 0.0)}) {
    const PlattScaling found = fit_platt(votes_by(slope / unit, offset, unit));
    EXPECT_NEAR(found.slope * unit, slope, 0.03) << slope << ", " << offset;
    EXPECT_NEAR(found.offset, offset, 0.03) << slope << ", " << offset;
  }
}

INSTANTIATE_TEST_SUITE_P(Units, PlattUnit, testing::Values(0.02, 1.0, 50.0));

TEST(FitPlatt, OfFewerThanTenVotesIsTheDefault) {
  const std::vector<Scored> nine(9, {1.0, false});
  EXPECT_EQ(fit_platt(nine).slope, PlattScaling{}.slope);
  EXPECT_EQ(fit_platt(nine).offset, PlattScaling{}.offset);
  EXPECT_LT(fit_platt(std::vector<Scored>(10, {1.0, false})).offset, 0.0);
}

TEST(FitPlatt, VotesThatAreAllRightGiveNoCertainty) {
  std::vector<Scored> votes;
  for (int i = 0; i < 30; ++i) {
    votes.push_back({0.1 * i, true});
  }
  const PlattScaling found = fit_platt(votes);
  EXPECT_NEAR(confidence_at(found, 1.5), 31.0 / 32.0, 0.01);  // Platt's target for 30 right votes
  EXPECT_LT(confidence_at(found, 3.0), 0.99);
}

TEST(FitPlatt, OfMarginsThatSayNothingIsTheShareThatIsRight) {
  std::vector<Scored> votes;
  for (int i = 0; i < 400; ++i) {
    votes.push_back({i % 2 == 0 ? 0.5 : 1.5, i / 2 % 4 != 0});
  }
  EXPECT_NEAR(confidence_at(fit_platt(votes), 1.0), 0.75, 0.01);
}

TEST(FitPlatt, ALargerMarginNeverMeansLessConfidence) {
  // Small margins are right, large ones are wrong: the best that rises is the share that is right, for every margin.
  std::vector<Scored> votes;
  for (int i = 0; i < 200; ++i) {
    votes.push_back({5.0 + 0.01 * i, i < 100});
  }
  const PlattScaling found = fit_platt(votes);
  EXPECT_EQ(found.slope, 0.0);
  EXPECT_NEAR(confidence_at(found, 6.0), 0.5, 0.01);
}

TEST(FitPlatt, AWeightCountsAsSoManyValues) {
  std::vector<Scored> once;
  std::vector<Scored> thrice;
  for (int i = 0; i < 40; ++i) {
    const Scored one{0.1 * i, i % 3 != 0 || i > 30, 1.0};
    once.push_back({one.value, one.positive, i % 2 == 0 ? 3.0 : 1.0});
    thrice.insert(thrice.end(), i % 2 == 0 ? 3 : 1, one);
  }
  EXPECT_NEAR(fit_platt(once).slope, fit_platt(thrice).slope, 1e-6);
  EXPECT_NEAR(fit_platt(once).offset, fit_platt(thrice).offset, 1e-6);
}

TEST(FitPlatt, OfEqualMarginsIsDefined) {
  std::vector<Scored> votes;
  for (int i = 0; i < 40; ++i) {
    votes.push_back({0.0, i % 4 != 0});
  }
  EXPECT_NEAR(confidence_at(fit_platt(votes), 0.0), 0.75, 0.03);
}

}  // namespace
}  // namespace spincat
