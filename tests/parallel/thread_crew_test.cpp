#include "spincat/parallel/thread_crew.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "spincat/spin/in_order.h"
#include "support/no_threads.h"

namespace spincat {
namespace {

// The first thread may be given and the second refused: those that wait for work must not be waited for.
TEST(ThreadCrew, SaysWhereNoThreadCanBeStarted) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers start threads of their own";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(test::end_without_threads(
                  [] { const ThreadCrew crew([](std::string_view task) { return std::string(task); }, 4); }),
              testing::ExitedWithCode(7), "");
  EXPECT_EXIT(test::end_without_threads([] { for_each_step(100, 4, [](std::size_t, std::size_t) {}); }),
              testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace spincat
