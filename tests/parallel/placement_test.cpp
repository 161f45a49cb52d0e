#include "spincat/parallel/placement.h"

#include <gtest/gtest.h>

namespace spincat {
namespace {

using Lines = std::vector<std::string>;

TEST(Placement, ThreadsAreAnEvenPartOfTheProcessors) {
  EXPECT_EQ(thread_count(0, Placement{8, 8, 4, 4}), 2);
  EXPECT_EQ(thread_count(0, Placement{8, 8, 3, 3}), 2);
  EXPECT_EQ(thread_count(0, Placement{2, 8, 4, 1}), 2);   // each rank has processors of its own
  EXPECT_EQ(thread_count(0, Placement{4, 64, 4, 4}), 1);  // ranks that share some of many
  EXPECT_EQ(thread_count(0, Placement{4, 64, 4, 2}), 2);
  EXPECT_EQ(thread_count(0, Placement{1, 64, 4, 4}), 1);
  EXPECT_EQ(thread_count(5, Placement{1, 64, 4, 4}), 5);
}

TEST(Placement, WarnsOfThreadsThatShareProcessors) {
  EXPECT_EQ(placement_warnings(2, Placement{8, 8, 4, 4}), Lines{});
  EXPECT_EQ(placement_warnings(1, Placement{1, 8, 8, 1}), Lines{});
  EXPECT_EQ(
      placement_warnings(4, Placement{1, 8, 2, 1}),
      Lines{"4 threads share the 1 processor that the launcher has bound this rank to (mpirun --bind-to none, srun "
            "--cpus-per-task)"});
  EXPECT_EQ(placement_warnings(4, Placement{4, 64, 4, 4}),
            Lines{"4 ranks of 4 threads share the 4 processors that the launcher has bound them to (mpirun --bind-to "
                  "none, srun --cpus-per-task)"});
  EXPECT_EQ(placement_warnings(1, Placement{4, 64, 4, 4}), Lines{});
  EXPECT_EQ(placement_warnings(3, Placement{8, 8, 4, 4}),
            Lines{"4 ranks of 3 threads share the 8 processors of this host"});
  EXPECT_EQ(placement_warnings(1, Placement{1, 1, 2, 2}),
            Lines{"2 ranks of 1 thread share the 1 processor of this host"});
}

}  // namespace
}  // namespace spincat
