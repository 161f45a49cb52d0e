#include "spincat/judge/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace spincat {
namespace {

double logistic(double t) {
  return 1.0 / (1.0 + std::exp(-t));
}

double confidence_at(const Calibration& calibration, double margin) {
  Ballot ballot;
  ballot.weakest_margin = static_cast<float>(margin);
  return calibration.confidence(ballot);
}

// A thousand votes at each of 41 margins from -unit to 2 unit, right as often as the logistic function says.
std::vector<JudgedObject> votes_by(double slope, double offset, double unit) {
  std::vector<JudgedObject> votes;
  for (int k = 0; k <= 40; ++k) {
    const double margin = unit * (-1.0 + 3.0 * k / 40.0);
    const long right = std::lround(1000.0 * logistic(slope * margin + offset));
    for (int i = 0; i < 1000; ++i) {
      votes.push_back({margin, i < right, 0.0});
    }
  }
  return votes;
}

TEST(Calibration, IsTheLogisticFunctionOfTheWeakestMargin) {
  EXPECT_DOUBLE_EQ(confidence_at({2.0, 0.0, 0.0}, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(confidence_at({2.0, 0.5, 0.0}, 1.0), logistic(2.5));
  for (const double margin : {-1e30, 1e30}) {
    EXPECT_GT(confidence_at({2.0, 0.0, 0.0}, margin), 0.0);
    EXPECT_LT(confidence_at({2.0, 0.0, 0.0}, margin), 1.0);
  }
}

class CalibrationUnit : public testing::TestWithParam<double> {};

TEST_P(CalibrationUnit, RecoversALogisticFunction) {
  const double unit = GetParam();  // of the margins
  for (const auto& [slope, offset] : {std::pair(4.0, -1.0), std::pair(0.7, 0.5), std::pair(2.0, 0.0)}) {
    const Calibration found = fit_calibration(votes_by(slope / unit, offset, unit));
    EXPECT_NEAR(found.slope * unit, slope, 0.03) << slope << ", " << offset;
    EXPECT_NEAR(found.offset, offset, 0.03) << slope << ", " << offset;
  }
}

INSTANTIATE_TEST_SUITE_P(Units, CalibrationUnit, testing::Values(0.02, 1.0, 50.0));

TEST(FitCalibration, OfFewerThanTenVotesIsTheDefault) {
  const std::vector<JudgedObject> nine(9, {1.0, false, 0.0});
  EXPECT_EQ(fit_calibration(nine).slope, Calibration{}.slope);
  EXPECT_EQ(fit_calibration(nine).offset, Calibration{}.offset);
  EXPECT_LT(fit_calibration(std::vector<JudgedObject>(10, {1.0, false, 0.0})).offset, 0.0);
}

TEST(FitCalibration, VotesThatAreAllRightGiveNoCertainty) {
  std::vector<JudgedObject> votes;
  for (int i = 0; i < 30; ++i) {
    votes.push_back({0.1 * i, true, 0.0});
  }
  const Calibration found = fit_calibration(votes);
  EXPECT_NEAR(confidence_at(found, 1.5), 31.0 / 32.0, 0.01);  // Platt's target for 30 right votes
  EXPECT_LT(confidence_at(found, 3.0), 0.99);
}

TEST(FitCalibration, OfMarginsThatSayNothingIsTheShareThatIsRight) {
  std::vector<JudgedObject> votes;
  for (int i = 0; i < 400; ++i) {
    votes.push_back({i % 2 == 0 ? 0.5 : 1.5, i / 2 % 4 != 0, 0.0});
  }
  EXPECT_NEAR(confidence_at(fit_calibration(votes), 1.0), 0.75, 0.01);
}

TEST(FitCalibration, ALargerMarginNeverMeansLessConfidence) {
  // Small margins are right, large ones are wrong: the best that rises is the share that is right, for every margin.
  std::vector<JudgedObject> votes;
  for (int i = 0; i < 200; ++i) {
    votes.push_back({5.0 + 0.01 * i, i < 100, 0.0});
  }
  const Calibration found = fit_calibration(votes);
  EXPECT_EQ(found.slope, 0.0);
  EXPECT_NEAR(confidence_at(found, 6.0), 0.5, 0.01);
}

// Known objects are familiar and unknown objects are not; margins tell right from wrong.
std::vector<JudgedObject> known_votes() {
  std::vector<JudgedObject> votes;
  for (int i = 0; i < 200; ++i) {
    const double margin = 0.01 * (i - 40);
    votes.push_back({margin, i % 50 < i / 4, 0.1 * (i % 7 - 3)});
  }
  return votes;
}

std::vector<JudgedObject> strangers_at(double familiarity) {
  std::vector<JudgedObject> unknown_objects;
  for (int i = 0; i < 200; ++i) {
    unknown_objects.push_back({0.01 * (i - 40), false, familiarity + 0.1 * (i % 7 - 3)});
  }
  return unknown_objects;
}

TEST(FitCalibration, StrangersMakeFamiliarityCount) {
  const Calibration alone = fit_calibration(known_votes());
  EXPECT_EQ(alone.familiarity_slope, 0.0);
  const Calibration with = fit_calibration(known_votes(), strangers_at(-3.0));
  EXPECT_GT(with.slope, 0.0);
  EXPECT_GT(with.familiarity_slope, 0.0);
  Ballot ballot;
  ballot.weakest_margin = 1.0F;
  EXPECT_GT(with.confidence(ballot, 0.0), with.confidence(ballot, -3.0) + 0.1);
}

TEST(FitCalibration, StrangersDoNotLowerTheConfidenceInKnownObjects) {
  const Calibration with = fit_calibration(known_votes(), strangers_at(-3.0));
  double confidence = 0.0;
  double right = 0.0;
  for (const JudgedObject& vote : known_votes()) {
    Ballot ballot;
    ballot.weakest_margin = static_cast<float>(vote.weakest_margin);
    confidence += with.confidence(ballot, vote.familiarity) / 200.0;
    right += vote.right ? 1.0 / 200.0 : 0.0;
  }
  EXPECT_NEAR(confidence, right, 0.02);
}

TEST(FitCalibration, FamiliarityNeverCountsAgainstAVote) {
  EXPECT_EQ(fit_calibration(known_votes(), strangers_at(+3.0)).familiarity_slope, 0.0);
}

TEST(FitCalibration, OfEqualMarginsIsDefined) {
  std::vector<JudgedObject> votes;
  for (int i = 0; i < 40; ++i) {
    votes.push_back({0.0, i % 4 != 0, 0.0});
  }
  EXPECT_NEAR(confidence_at(fit_calibration(votes), 0.0), 0.75, 0.03);
}

}  // namespace
}  // namespace spincat
