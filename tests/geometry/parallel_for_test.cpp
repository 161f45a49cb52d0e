#include "spincat/geometry/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "support/no_threads.h"

namespace spincat {
namespace {

TEST(ParallelFor, SaysWhereNoThreadCanBeStarted) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers start threads of their own";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(test::end_without_threads([] { parallel_for(100, 2, [](std::size_t) {}); }), testing::ExitedWithCode(7),
              "");
}

TEST(ParallelFor, OneThreadIsTheCallersOwn) {
  const auto here = std::this_thread::get_id();
  parallel_for(10, 1, [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), here); });
}

TEST(ParallelFor, StartsNoMoreThreadsThanCalls) {
  std::atomic<int> calls = 0;
  parallel_for(1, 1'000'000, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace spincat
