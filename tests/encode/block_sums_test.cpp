#include "spincat/encode/block_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spincat {
namespace {

SumsTree leaves(std::size_t first, std::size_t end) {
  SumsTree tree;
  for (std::size_t i = first; i < end; ++i) {
    tree.add({0, {std::sin(static_cast<double>(i)), 1.0}});
  }
  return tree;
}

TEST(SumsTree, AnySharingOutOfWholeSubtreesGivesTheSameBits) {
  for (const std::size_t count : {1U, 2U, 3U, 7U, 8U, 21U, 64U, 100U}) {
    const std::vector<double> expected = leaves(0, count).total();
    EXPECT_EQ(expected[1], static_cast<double>(count));
    for (const std::size_t run : {1U, 2U, 4U, 8U, 16U, 128U}) {
      SumsTree shared;
      for (std::size_t first = 0; first < count; first += run) {
        const SumsTree part = leaves(first, std::min(count, first + run));
        for (const SumsNode& node : part.nodes()) {
          shared.add(node);
        }
      }
      EXPECT_EQ(shared.total(), expected) << count << " leaves in runs of " << run;
    }
  }
}

// The plain order gives other bits: the test above would notice.
TEST(SumsTree, TheOrderDoesMatter) {
  double plain = 0.0;
  for (std::size_t i = 0; i < 100; ++i) {
    plain += std::sin(static_cast<double>(i));
  }
  EXPECT_NE(leaves(0, 100).total()[0], plain);
  EXPECT_NEAR(leaves(0, 100).total()[0], plain, 1e-12);
}

TEST(SumsTree, WholeSubtreesBecomeOneNode) {
  EXPECT_EQ(leaves(0, 64).nodes().size(), 1U);
  EXPECT_EQ(leaves(0, 64).nodes()[0].level, 6U);
  EXPECT_EQ(leaves(0, 7).nodes().size(), 3U);
}

}  // namespace
}  // namespace spincat
