#include "spincat/judge/familiarity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spincat/judge/ballot.h"

namespace spincat {
namespace {

// Objects on a line: category 0 at 0, 1 and 3, category 1 at 100.
Familiarity on_a_line() {
  FeatureMatrix objects(4, 1);
  objects << 0.0F, 1.0F, 3.0F, 100.0F;
  return make_familiarity(objects, {0, 0, 0, 1}, 2);
}

double of(const Familiarity& familiarity, float x, std::uint32_t category) {
  return familiarity.of(std::vector{x}, category);
}

TEST(Familiarity, ComparesWithHowNearTheObjectsOfACategoryLie) {
  // Squared distances to the nearest neighbour: 1, 1, 4; mean 2, deviation sqrt 2, and a fifth of the mean.
  const Familiarity familiarity = on_a_line();
  EXPECT_NEAR(familiarity.typical[0], 2.0, 1e-6);
  EXPECT_NEAR(familiarity.spread[0], std::sqrt(2.0) + 0.4, 1e-6);
  EXPECT_NEAR(of(familiarity, 1.0F, 0), 2.0 / (std::sqrt(2.0) + 0.4), 1e-6);
  EXPECT_NEAR(of(familiarity, 5.0F, 0), (2.0 - 4.0) / (std::sqrt(2.0) + 0.4), 1e-6);
  EXPECT_LT(of(familiarity, 60.0F, 0), -100.0);
}

TEST(Familiarity, OfACategoryWithOneObjectGoesByTheOthers) {
  const Familiarity familiarity = on_a_line();
  EXPECT_EQ(familiarity.typical[1], familiarity.typical[0]);
  EXPECT_EQ(familiarity.spread[1], familiarity.spread[0]);
  EXPECT_GT(of(familiarity, 100.0F, 1), 0.0);
}

TEST(Familiarity, OfNothingOrOfEqualObjectsIsDefined) {
  EXPECT_EQ(Familiarity{}.of(std::vector{1.0F}, 7), 0.0);
  EXPECT_TRUE(Familiarity{}.empty());
  FeatureMatrix equal(3, 1);
  equal << 2.0F, 2.0F, 2.0F;
  const Familiarity familiarity = make_familiarity(equal, {0, 0, 1}, 2);
  EXPECT_EQ(of(familiarity, 2.0F, 0), 0.0);
  EXPECT_TRUE(std::isfinite(of(familiarity, 3.0F, 0)));
}

TEST(BallotWithout, IsTheVoteOfTheOtherJudges) {
  // Pairs (0,1), (0,2), (0,3), (1,2), (1,3), (2,3); category 1 wins them all, category 3 the rest.
  const Ballot whole = count_votes(4, std::vector<float>{-1.0F, 0.5F, -0.25F, 2.0F, 3.0F, -4.0F});
  ASSERT_EQ(whole.winner, 1U);
  const Ballot rest = ballot_without(whole, 1);
  EXPECT_EQ(rest.winner, 3U);
  EXPECT_EQ(rest.runner_up, 0U);
  EXPECT_EQ(rest.weakest_margin, 0.25F);
  EXPECT_EQ(rest.count, (std::vector<std::uint32_t>{1, 0, 0, 2}));
  ASSERT_EQ(rest.votes.size(), 3U);
  EXPECT_EQ(rest.votes[2].category_a, 2U);
  EXPECT_EQ(rest.votes[2].category_b, 3U);
  EXPECT_EQ(rest.votes[2].margin, -4.0F);
  EXPECT_EQ(ballot_without(whole, 3).winner, 1U);
}

TEST(Familiarity, RowsOfOneObjectAreNoNeighbours) {
  FeatureMatrix objects(6, 1);
  objects << 0.0F, 0.1F, 3.0F, 3.1F, 10.0F, 10.1F;
  const Familiarity by_object = make_familiarity(objects, {0, 0, 0, 0, 1, 1}, 2, 2);
  // 0 -> 3, .1 -> 3, 3 -> .1, 3.1 -> .1: squared 9, 8.41, 8.41, 9; category 1 has no other object and takes the mean.
  EXPECT_NEAR(by_object.typical[0], 8.705F, 1e-4F);
  EXPECT_NEAR(by_object.typical[1], 8.705F, 1e-4F);
  EXPECT_NEAR(make_familiarity(objects, {0, 0, 0, 0, 1, 1}, 2).typical[0], 0.01F, 1e-4F);
}

}  // namespace
}  // namespace spincat
