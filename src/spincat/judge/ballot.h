// The vote on one object: what every judge said, and what came of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

// One judge's word on one object.
struct Vote {
  std::uint32_t category_a = 0;  // the two categories it tells apart, a < b
  std::uint32_t category_b = 0;
  float margin = 0.0F;  // its SVM's decision value: > 0 speaks for a, otherwise for b; 1 is the edge of the margin
  std::uint32_t choice() const { return margin > 0.0F ? category_a : category_b; }
};

enum class TieBreak {
  none,       // one category had more votes than any other
  margins,    // several had the most votes: the largest sum of their margins (over all their judges) won
  first_one,  // even those sums were equal: the first of them in the order of the categories won
};

struct Ballot {
  std::vector<Vote> votes;           // of all L = n (n - 1) / 2 judges, in the order (0,1), (0,2), ..., (1,2), ...
  std::vector<std::uint32_t> count;  // votes for each category
  std::vector<float> margin_sum;     // for each category: its judges' margins, signed in its favour, added up
  std::uint32_t winner = 0;
  std::uint32_t runner_up = 0;  // the best of the others, by the same rules
  TieBreak tie_break = TieBreak::none;
  float weakest_margin = 0.0F;  // the winner's smallest margin over all its judges: how close it was
};

// Counts the votes: most votes win, ties by the rules of TieBreak. `margins` holds one decision value for each judge in
// the order above. Deterministic. Precondition: categories >= 2, margins.size() == categories (categories - 1) / 2.
Ballot count_votes(std::uint32_t categories, std::span<const float> margins);

// Votes on one object added up: on several views of it, or over the frames in which it was seen.
struct SummedVotes {
  std::uint32_t ballots = 0;
  std::vector<std::uint32_t> count;  // votes for each category
  std::vector<double> margin_sum;    // for each category
  std::uint32_t winner = 0;          // by the rules of a single ballot
  std::uint32_t runner_up = 0;
};

// Precondition: one or more ballots of the same judges.
SummedVotes sum_votes(std::span<const Ballot> ballots);

// The vote as it would be if no judge knew `category`: what comes of an object whose category was never learned. The
// other categories keep their numbers; `category` has no votes. Precondition: three or more categories.
Ballot ballot_without(const Ballot& ballot, std::uint32_t category);

}  // namespace spincat
#pragma GCC visibility pop
