#include "spincat/judge/ballot.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace spincat {
namespace {

// Categories, the best first: by votes, then by margins, then by their order.
template <class Counted>
std::vector<std::uint32_t> ranking(const Counted& votes) {
  std::vector<std::uint32_t> order(votes.count.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return votes.count[a] != votes.count[b] ? votes.count[a] > votes.count[b]
                                            : votes.margin_sum[a] > votes.margin_sum[b];
  });
  return order;
}

}  // namespace

Ballot count_votes(std::uint32_t categories, std::span<const float> margins) {
  Ballot ballot;
  ballot.count.assign(categories, 0);
  ballot.margin_sum.assign(categories, 0.0F);
  std::vector<float> weakest(categories, std::numeric_limits<float>::infinity());
  std::size_t judge = 0;
  for (std::uint32_t a = 0; a < categories; ++a) {
    for (std::uint32_t b = a + 1; b < categories; ++b, ++judge) {
      const Vote vote{a, b, margins[judge]};
      ballot.votes.push_back(vote);
      ++ballot.count[vote.choice()];
      ballot.margin_sum[a] += vote.margin;
      ballot.margin_sum[b] -= vote.margin;
      weakest[a] = std::min(weakest[a], vote.margin);
      weakest[b] = std::min(weakest[b], -vote.margin);
    }
  }
  const std::vector<std::uint32_t> order = ranking(ballot);
  ballot.winner = order[0];
  ballot.runner_up = order[1];
  if (ballot.count[order[0]] == ballot.count[order[1]]) {
    ballot.tie_break =
        ballot.margin_sum[order[0]] > ballot.margin_sum[order[1]] ? TieBreak::margins : TieBreak::first_one;
  }
  ballot.weakest_margin = weakest[ballot.winner];
  return ballot;
}

SummedVotes sum_votes(std::span<const Ballot> ballots) {
  SummedVotes sum;
  sum.ballots = static_cast<std::uint32_t>(ballots.size());
  sum.count.assign(ballots.front().count.size(), 0);
  sum.margin_sum.assign(sum.count.size(), 0.0);
  for (const Ballot& ballot : ballots) {
    std::ranges::transform(sum.count, ballot.count, sum.count.begin(), std::plus<>());
    std::ranges::transform(sum.margin_sum, ballot.margin_sum, sum.margin_sum.begin(), std::plus<>());
  }
  const std::vector<std::uint32_t> order = ranking(sum);
  sum.winner = order[0];
  sum.runner_up = order[1];
  return sum;
}

Ballot ballot_without(const Ballot& ballot, std::uint32_t category) {
  std::vector<float> margins;
  for (const Vote& vote : ballot.votes) {
    if (vote.category_a != category && vote.category_b != category) {
      margins.push_back(vote.margin);
    }
  }
  Ballot result = count_votes(static_cast<std::uint32_t>(ballot.count.size()) - 1, margins);
  const auto renumber = [&](std::uint32_t& number) { number += number >= category ? 1 : 0; };
  for (Vote& vote : result.votes) {
    renumber(vote.category_a);
    renumber(vote.category_b);
  }
  renumber(result.winner);
  renumber(result.runner_up);
  result.count.insert(result.count.begin() + category, 0);
  result.margin_sum.insert(result.margin_sum.begin() + category, 0.0F);
  return result;
}

}  // namespace spincat
