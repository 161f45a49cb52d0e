#include "spincat/io/read_limits.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace spincat {
namespace {

TEST(ReadLimits, LetMemoryGrowWithTheFile) {
  const auto error = [](std::uint64_t memory, std::uint64_t size, std::size_t growth) {
    return test::input_error([&] { check_growth(memory, size, {.max_growth = growth}); });
  };
  EXPECT_EQ(error(16'000'000, 0, 20), "no error");
  EXPECT_EQ(error(18'000'000, 100'000, 20), "no error");
  EXPECT_EQ(error(18'000'020, 100'000, 20),
            "would take 18000020 bytes of memory, more than 20 times its 100000 bytes and 16 MB; --max-growth raises "
            "this limit");
  EXPECT_EQ(error(18'000'020, 100'000, 21), "no error");
  EXPECT_NE(error(~std::uint64_t{0}, ~std::uint64_t{0} / 30, 20), "no error");  // 20 times this wraps around
}

}  // namespace
}  // namespace spincat
