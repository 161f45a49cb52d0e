#include "spincat/parallel/for_each.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace spincat {
namespace {

class ForEachIndex : public testing::TestWithParam<int> {};

TEST_P(ForEachIndex, CallsEachIndexOnce) {
  for (const std::size_t count : {1U, 2U, 3U, 100U}) {
    std::vector<std::atomic<int>> calls(count);
    for_each_index(count, GetParam(), [&](std::size_t i) { ++calls.at(i); });
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(calls[i], 1) << i << " of " << count;
    }
  }
}

TEST_P(ForEachIndex, DoesNothingForNothing) {
  for_each_index(0, GetParam(), [](std::size_t) { FAIL(); });
}

TEST_P(ForEachIndex, ThrowsTheErrorOfTheSmallestIndexThatFails) {
  for (int round = 0; round < 20; ++round) {
    try {
      for_each_index(100, GetParam(), [](std::size_t i) {
        if (i == 7) {  // the others have failed long before
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (i >= 7) {
          throw std::runtime_error(std::to_string(i));
        }
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::string("7"));
    }
  }
}

TEST_P(ForEachIndex, StartsNoNewCallsAfterOneFailed) {
  std::atomic<int> calls = 0;
  EXPECT_THROW(for_each_index(10'000, GetParam(),
                              [&](std::size_t i) {
                                ++calls;
                                if (i == 0) {
                                  throw std::runtime_error("first");
                                }
                                std::this_thread::sleep_for(std::chrono::microseconds(100));
                              }),
               std::runtime_error);
  EXPECT_LT(calls, 10'000);
}

INSTANTIATE_TEST_SUITE_P(Threads, ForEachIndex, testing::Values(1, 2, 3, 4));

TEST(ThreadCount, IsWhatWasAskedForOrAtLeastOne) {
  EXPECT_EQ(thread_count(3), 3);
  EXPECT_GE(thread_count(0), 1);
}

}  // namespace
}  // namespace spincat
