#include "spincat/dataset/splits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "support/expect_error.h"

namespace spincat {

bool operator==(const Split& a, const Split& b) {
  return a.train == b.train && a.test == b.test;
}

namespace {

using test::input_error;
using Labels = std::vector<std::uint32_t>;
using Indices = std::vector<std::uint32_t>;

// Categories of 1, 2, 5, 30 and 69 objects in an order of no pattern; the labels need not be 0, 1, 2, ...
Labels mixed_labels() {
  Labels labels;
  for (const std::uint32_t size : {1U, 2U, 5U, 30U, 69U}) {
    labels.insert(labels.end(), size, size * 1000);
  }
  Labels mixed(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    mixed[i * 40 % labels.size()] = labels[i];
  }
  return mixed;
}

std::map<std::uint32_t, int> counts_of(const Labels& labels, const Indices& indices) {
  std::map<std::uint32_t, int> counts;
  for (const std::uint32_t i : indices) {
    ++counts[labels[i]];
  }
  return counts;
}

void expect_complete(const Split& split, std::size_t objects) {
  EXPECT_TRUE(std::is_sorted(split.train.begin(), split.train.end()));
  EXPECT_TRUE(std::is_sorted(split.test.begin(), split.test.end()));
  Indices all;
  std::merge(split.train.begin(), split.train.end(), split.test.begin(), split.test.end(), std::back_inserter(all));
  Indices expected(objects);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(all, expected);
}

TEST(Splits, HoldEachObjectOnceAndExactCounts) {
  const Labels labels = mixed_labels();
  for (const Split& split : stratified_splits(labels, 10, 0.3, 1)) {
    expect_complete(split, labels.size());
    // 2 x 0.3 = 0.6, 5 x 0.3 = 1.5 to even, 30 x 0.3 = 9, 69 x 0.3 = 20.7
    EXPECT_EQ(counts_of(labels, split.test),
              (std::map<std::uint32_t, int>{{2000, 1}, {5000, 2}, {30000, 9}, {69000, 21}}));
  }
}

TEST(Splits, RoundTiesToEvenAndKeepAnObjectOnEitherSide) {
  const auto tested = [](std::size_t objects, double share) {
    return stratified_splits(Labels(objects, 7), 1, share, 1)[0].test.size();
  };
  EXPECT_EQ(tested(5, 0.5), 2U);
  EXPECT_EQ(tested(7, 0.5), 4U);
  EXPECT_EQ(tested(25, 0.1), 2U);
  EXPECT_EQ(tested(3, 0.01), 1U);
  EXPECT_EQ(tested(3, 0.99), 2U);
}

TEST(Splits, AreTheSameForTheSameSeedWhateverTheirNumber) {
  const Labels labels = mixed_labels();
  const auto three = stratified_splits(labels, 3, 0.3, 5);
  const auto eight = stratified_splits(labels, 8, 0.3, 5);
  EXPECT_TRUE(std::equal(three.begin(), three.end(), eight.begin()));
  EXPECT_EQ(stratified_splits(labels, 8, 0.3, 5), eight);
  EXPECT_NE(stratified_splits(labels, 3, 0.3, 6), three);
  for (std::size_t i = 1; i < eight.size(); ++i) {
    EXPECT_FALSE(eight[i] == eight[i - 1]);
  }
}

// Worked out by a second program. They must never change: published results would no longer be repeatable.
TEST(Splits, AreTheSameOnEveryMachine) {
  const Labels labels = {0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  const auto splits = stratified_splits(labels, 2, 0.4, 42);
  EXPECT_EQ(splits[0].test, (Indices{2, 3, 8, 9}));
  EXPECT_EQ(splits[1].test, (Indices{0, 1, 4, 9}));
  EXPECT_EQ(stratified_folds(labels, 3, 42)[0].test, (Indices{1, 3, 8, 9}));
}

TEST(Splits, TakeEachObjectAboutAsOften) {
  std::vector<int> tested(10);
  for (const Split& split : stratified_splits(Labels(10, 0), 2000, 0.3, 3)) {
    for (const std::uint32_t i : split.test) {
      ++tested[i];
    }
  }
  for (const int times : tested) {
    EXPECT_NEAR(times, 600, 5 * std::sqrt(2000 * 0.3 * 0.7));
  }
}

TEST(Splits, RefuseWhatCannotBe) {
  const Labels pair = {0, 0};
  const auto error = [](const Labels& labels, int count, double share) {
    return input_error([&] { stratified_splits(labels, count, share, 1); });
  };
  EXPECT_EQ(error(pair, 1, 0.0), "test share 0 is out of range (more than 0 and less than 1)");
  EXPECT_EQ(error(pair, 1, 1.0), "test share 1 is out of range (more than 0 and less than 1)");
  EXPECT_EQ(error(pair, 1, std::numeric_limits<double>::quiet_NaN()),
            "test share nan is out of range (more than 0 and less than 1)");
  EXPECT_EQ(error(pair, 0, 0.5), "number of splits 0 is out of range (1 to 10000)");
  EXPECT_EQ(error({0, 1}, 1, 0.5), "no category has two objects, one to train on and one to test on");
  EXPECT_EQ(error({}, 1, 0.5), "no category has two objects, one to train on and one to test on");
}

TEST(Folds, TestEachObjectOnceAndAreStratified) {
  const Labels labels = mixed_labels();
  const auto folds = stratified_folds(labels, 5, 9);
  std::vector<int> tested(labels.size());
  for (const Split& fold : folds) {
    expect_complete(fold, labels.size());
    EXPECT_NEAR(static_cast<double>(fold.test.size()), 107.0 / 5, 1.0);
    auto counts = counts_of(labels, fold.test);
    EXPECT_EQ(counts[30000], 6);
    EXPECT_EQ(counts[5000], 1);
    EXPECT_TRUE(counts[69000] == 13 || counts[69000] == 14);
    for (const std::uint32_t i : fold.test) {
      ++tested[i];
    }
  }
  EXPECT_EQ(tested, std::vector<int>(labels.size(), 1));
  EXPECT_EQ(stratified_folds(labels, 5, 9), folds);
  EXPECT_NE(stratified_folds(labels, 5, 10), folds);
}

TEST(Folds, MayLeaveOneOut) {
  const Labels labels = mixed_labels();
  const auto folds = stratified_folds(labels, static_cast<int>(labels.size()), 9);
  ASSERT_EQ(folds.size(), labels.size());
  for (const Split& fold : folds) {
    EXPECT_EQ(fold.test.size(), 1U);
    expect_complete(fold, labels.size());
  }
}

TEST(Folds, RefuseWhatCannotBe) {
  const Labels labels = {0, 0, 1};
  EXPECT_EQ(input_error([&] { stratified_folds(labels, 1, 1); }),
            "the number of folds is 1; expected 2 to 3, the number of objects");
  EXPECT_EQ(input_error([&] { stratified_folds(labels, 4, 1); }),
            "the number of folds is 4; expected 2 to 3, the number of objects");
}

}  // namespace
}  // namespace spincat
