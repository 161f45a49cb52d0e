#include "spincat/geometry/left_out.h"

#include <gtest/gtest.h>

namespace spincat {
namespace {

using Rows = std::vector<std::uint32_t>;

TEST(RowsOfKept, AreThoseThatWereNotLeftOut) {
  EXPECT_EQ(rows_of_kept(3, Rows{}), (Rows{0, 1, 2}));
  EXPECT_EQ(rows_of_kept(3, Rows{0, 1}), (Rows{2, 3, 4}));
  EXPECT_EQ(rows_of_kept(3, Rows{1, 4, 5}), (Rows{0, 2, 3}));
  EXPECT_EQ(rows_of_kept(0, Rows{0}), Rows{});
}

}  // namespace
}  // namespace spincat
