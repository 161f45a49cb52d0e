#include "spincat/judge/ballot.h"

#include <gtest/gtest.h>

#include <vector>

namespace spincat {
namespace {

using Counts = std::vector<std::uint32_t>;

TEST(Ballot, OfTwoCategoriesIsOneVote) {
  const Ballot ballot = count_votes(2, std::vector<float>{-0.25F});
  ASSERT_EQ(ballot.votes.size(), 1U);
  EXPECT_EQ(ballot.votes[0].choice(), 1U);
  EXPECT_EQ(ballot.count, (Counts{0, 1}));
  EXPECT_EQ(ballot.winner, 1U);
  EXPECT_EQ(ballot.runner_up, 0U);
  EXPECT_EQ(ballot.tie_break, TieBreak::none);
  EXPECT_EQ(ballot.weakest_margin, 0.25F);
}

TEST(Ballot, AMarginOfZeroSpeaksForTheSecond) {
  EXPECT_EQ(count_votes(2, std::vector<float>{0.0F}).winner, 1U);
  EXPECT_EQ(count_votes(2, std::vector<float>{1e-30F}).winner, 0U);
}

TEST(Ballot, TheMajorityWinsWhateverTheMargins) {
  // (0,1) (0,2) (0,3) (1,2) (1,3) (2,3): category 2 has three votes by little, 0 two by much.
  const std::vector<float> margins = {5.0F, -0.1F, 6.0F, -0.2F, 0.5F, 0.3F};
  const Ballot ballot = count_votes(4, margins);
  EXPECT_EQ(ballot.count, (Counts{2, 1, 3, 0}));
  EXPECT_EQ(ballot.winner, 2U);
  EXPECT_EQ(ballot.runner_up, 0U);
  EXPECT_EQ(ballot.tie_break, TieBreak::none);
  EXPECT_FLOAT_EQ(ballot.weakest_margin, 0.1F);
  EXPECT_FLOAT_EQ(ballot.margin_sum[0], 10.9F);
  EXPECT_FLOAT_EQ(ballot.margin_sum[1], -5.0F - 0.2F + 0.5F);
  EXPECT_FLOAT_EQ(ballot.margin_sum[2], 0.1F + 0.2F + 0.3F);
  EXPECT_FLOAT_EQ(ballot.margin_sum[3], -6.0F - 0.5F - 0.3F);
}

TEST(Ballot, KeepsTheVotesInTheOrderOfThePairs) {
  const Ballot ballot = count_votes(4, std::vector<float>{1, 2, 3, 4, 5, 6});
  ASSERT_EQ(ballot.votes.size(), 6U);
  float margin = 1.0F;
  std::size_t judge = 0;
  for (std::uint32_t a = 0; a < 4; ++a) {
    for (std::uint32_t b = a + 1; b < 4; ++b, ++judge) {
      EXPECT_EQ(ballot.votes[judge].category_a, a);
      EXPECT_EQ(ballot.votes[judge].category_b, b);
      EXPECT_EQ(ballot.votes[judge].margin, margin++);
    }
  }
}

TEST(Ballot, ATieGoesToTheLargestSumOfMargins) {
  // 0 beats 1 by 1, 1 beats 2 by 3, 2 beats 0 by 1.5: sums -0.5, 2, -1.5.
  const Ballot ballot = count_votes(3, std::vector<float>{1.0F, -1.5F, 3.0F});
  EXPECT_EQ(ballot.count, (Counts{1, 1, 1}));
  EXPECT_EQ(ballot.winner, 1U);
  EXPECT_EQ(ballot.runner_up, 0U);
  EXPECT_EQ(ballot.tie_break, TieBreak::margins);
  EXPECT_EQ(ballot.weakest_margin, -1.0F);  // the judge that spoke against the winner
}

TEST(Ballot, ACompleteTieGoesToTheFirst) {
  const Ballot ballot = count_votes(3, std::vector<float>{2.0F, -2.0F, 2.0F});
  EXPECT_EQ(ballot.count, (Counts{1, 1, 1}));
  EXPECT_EQ(ballot.winner, 0U);
  EXPECT_EQ(ballot.runner_up, 1U);
  EXPECT_EQ(ballot.tie_break, TieBreak::first_one);
  EXPECT_EQ(ballot.weakest_margin, -2.0F);
}

TEST(Ballot, ATieForTheSecondPlaceIsNoTie) {
  // 0 wins both; 1 and 2 would tie but for their own judge.
  const Ballot ballot = count_votes(3, std::vector<float>{1.0F, 1.0F, -0.5F});
  EXPECT_EQ(ballot.winner, 0U);
  EXPECT_EQ(ballot.runner_up, 2U);
  EXPECT_EQ(ballot.tie_break, TieBreak::none);
  EXPECT_EQ(ballot.weakest_margin, 1.0F);
}

TEST(SummedVotes, AreCountedLikeASingleBallot) {
  // Two frames speak for 1 by little, one for 0 by much: votes 0: 1 + 1 + 2, 1: 2 + 2 + 1, 2: none.
  const std::vector<Ballot> ballots = {count_votes(3, std::vector<float>{-0.1F, 0.1F, 0.1F}),
                                       count_votes(3, std::vector<float>{-0.1F, 0.1F, 0.1F}),
                                       count_votes(3, std::vector<float>{9.0F, 9.0F, 0.1F})};
  const SummedVotes sum = sum_votes(ballots);
  EXPECT_EQ(sum.ballots, 3U);
  EXPECT_EQ(sum.count, (Counts{4, 5, 0}));
  EXPECT_EQ(sum.winner, 1U);
  EXPECT_EQ(sum.runner_up, 0U);
  EXPECT_NEAR(sum.margin_sum[0], 18.0, 1e-5);
  // As many votes for both: the margins decide.
  const SummedVotes tied = sum_votes(std::vector<Ballot>{ballots[0], ballots[2]});
  EXPECT_EQ(tied.count, (Counts{3, 3, 0}));
  EXPECT_EQ(tied.winner, 0U);
  EXPECT_EQ(sum_votes(std::vector<Ballot>{ballots[1]}).winner, ballots[1].winner);
}

}  // namespace
}  // namespace spincat
