#include "spincat/geometry/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace spincat {
namespace {

// The golden values come from a Mersenne twister written again from its definition, in another language.

TEST(Random, UniformIsTheUpper53BitsOfTheStandardTwister) {
  Random random(1);
  EXPECT_EQ(random.uniform(), 0x1.122deafddb434p-3);
  EXPECT_EQ(random.uniform(), 0x1.175c928118c7cp-3);
  EXPECT_EQ(random.uniform(), 0x1.ce0b479deb990p-2);
}

TEST(Random, UniformOfARangeStaysInIt) {
  Random random(1);
  EXPECT_DOUBLE_EQ(random.uniform(-2.0, 6.0), -2.0 + 8.0 * 0x1.122deafddb434p-3);
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(3.0, 4.0);
    EXPECT_GE(u, 3.0);
    EXPECT_LT(u, 4.0);
  }
}

TEST(Random, BelowGivesGoldenNumbers) {
  Random random(1);
  for (const std::uint64_t expected : {8, 2, 0, 6, 4, 9, 8, 5, 8, 4}) {
    EXPECT_EQ(random.below(10), expected);
  }
  EXPECT_EQ(random.below(1), 0U);
}

TEST(Random, BelowDrawsAgainWhereTheRemainderWouldBeBiased) {
  // Of a bound just above 2^63 almost half of the 64-bit numbers lie beyond its largest multiple; the sixth does.
  Random random(1);
  const std::uint64_t bound = (std::uint64_t{1} << 63) + 1;
  for (const std::uint64_t expected : {2469588189546311528ULL, 2516265689700432462ULL, 8323445853463659930ULL,
                                       387828560950575246ULL, 6472927700900931384ULL, 8683844110200328628ULL}) {
    EXPECT_EQ(random.below(bound), expected);
  }
}

TEST(Random, BelowIsEven) {
  Random random(7);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70'000; ++i) {
    ++counts[random.below(7)];
  }
  for (const int count : counts) {
    EXPECT_NEAR(count, 10'000, 5 * std::sqrt(10'000.0 * 6 / 7));  // five standard deviations
  }
}

TEST(Random, NormalIsBoxMuller) {
  EXPECT_NEAR(Random(1).normal(), 0.35099249780849107, 1e-15);
}

TEST(Random, NormalHasMeanZeroAndDeviationOne) {
  Random random(3);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 40'000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
}

TEST(Random, ShuffleIsFisherYatesFromTheEnd) {
  std::vector<int> values = {0, 1, 2, 3, 4, 5, 6, 7};
  Random(1).shuffle(values);
  EXPECT_EQ(values, (std::vector<int>{4, 6, 3, 5, 1, 7, 2, 0}));
}

TEST(Random, ShuffleOfNothingAndOfOneIsDefined) {
  std::vector<int> none;
  std::vector<int> one = {5};
  Random random(1);
  random.shuffle(none);
  random.shuffle(one);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(one, std::vector<int>{5});
}

TEST(DeriveSeed, GivesGoldenSeeds) {
  EXPECT_EQ(derive_seed(1, 0), 10451216379200822465ULL);
  EXPECT_EQ(derive_seed(1, 1), 13757245211066428519ULL);
  EXPECT_EQ(derive_seed(0, 0), 16294208416658607535ULL);
}

TEST(DeriveSeed, NearbySeedsAndPurposesGiveDifferentSeeds) {
  // One purpose of one seed must not be another purpose of the next: the seeds of all lie on different points of a line
  // of step 0x9E37... and the finaliser is one to one.
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (std::uint64_t purpose = 0; purpose < 100; ++purpose) {
      seen.insert(derive_seed(seed, purpose));
    }
  }
  EXPECT_EQ(seen.size(), 10'000U);
}

}  // namespace
}  // namespace spincat
