// A call of MPI that fails on one rank, sending or receiving: what came after it would be put together wrongly.
#include <gtest/gtest.h>

#include <tuple>

#include "mpi/launching.h"
#include "spincat/parallel/farm_messages.h"

namespace spincat::test {
namespace {

const std::string kSmall = "--background 8 --copies 1 --spin-points 128";  // the runs are many

class BrokenLinks : public Launching, public testing::WithParamInterface<Mpi> {
 protected:
  void SetUp() override {
    if (const std::string reason = reason_to_skip(GetParam()); !reason.empty()) {
      GTEST_SKIP() << reason;
    }
    make_dataset(12);
    ASSERT_EQ(alone("train boxes --threads 1 -o alone.spincat " + kSmall).code, 0);
  }

  RunResult run_with(const std::string& failure, const std::string& arguments, const std::string& environment = "") {
    const Mpi& mpi = GetParam();
    RunResult result = shell(
        fmt::format("{} {} -n 3 env LD_PRELOAD={}{}.so SPINCAT_FAIL='{}' SPINCAT_DEADLINE=0.5 {} '{}' {}", mpi.launcher,
                    mpi.recovery, SPINCAT_FAILING_MPI, mpi.name, failure, environment, SPINCAT_COMMAND, arguments));
    EXPECT_TRUE(result.code != 124 && result.code != 137) << failure << " hangs\n" << result.err;
    EXPECT_EQ(result.err.find("/spincat("), std::string::npos) << failure << " makes us crash\n" << result.err;
    return result;
  }

  RunResult train_with(const std::string& failure, const std::string& more = kSmall,
                       const std::string& environment = "") {
    fs::remove(dir_.path() / "ranks.spincat");
    RunResult result = run_with(failure, "train boxes --threads 1 -o ranks.spincat " + more, environment);
    EXPECT_TRUE(has_come(failure)) << failure << " did not come";
    return result;
  }

  bool has_come(const std::string& failure) const { return fs::exists(dir_.path() / failure); }

  // The result is complete before a rank is given up, whatever the launcher then makes of it: Open MPI's may crash at
  // its own end.
  void expect_right_after(const std::string& failure) {
    const RunResult result = train_with(failure);
    EXPECT_TRUE(bytes("ranks.spincat") == bytes("alone.spincat")) << failure << "\n" << result.err;
  }
};

INSTANTIATE_TEST_SUITE_P(Mpi, BrokenLinks, testing::Values(kOpenMpi, kMpich),
                         [](const auto& each) { return each.param.name; });

TEST_P(BrokenLinks, CostNothingButTime) {
  for (const char* function : {"MPI_Isend", "MPI_Imrecv", "MPI_Test"}) {
    for (const int rank : {0, 1}) {
      for (const int call : {4, 7}) {  // after the greetings
        expect_right_after(fmt::format("{} {} {}", rank, function, call));
      }
    }
  }
}

// What all ranks need to train: the table, the inner products, the trainings, and whether a rank is ready for them.
TEST_P(BrokenLinks, WhileOtherRanksTrainCostNothingButTime) {
  constexpr int kObjects = 36;
  const std::string small = "--copies 1 --dimensions 0 --points 256 --spin-points 32";
  ASSERT_EQ(alone("train boxes --threads 1 -o alone.spincat " + small).code, 0);
  const std::vector<std::tuple<int, farm::Tag, int>> failures = {
      {0, farm::kJob, 3},                   // two ranks were told to describe objects: the table
      {0, farm::kJob, 5},                   // the inner products
      {0, farm::kBroadcast, kObjects + 1},  // the first of these
      {0, farm::kJob, 7},                   // the trainings
      {1, farm::kReady, 3},                 // for the inner products
      {1, farm::kReady, 4}};                // for the trainings
  for (const auto& [rank, tag, call] : failures) {
    const std::string failure = fmt::format("{} MPI_Isend:{} {}", rank, static_cast<int>(tag), call);
    const RunResult result = train_with(failure, small, kShareAlways);
    EXPECT_TRUE(bytes("ranks.spincat") == bytes("alone.spincat")) << failure << "\n" << result.err;
    EXPECT_NE(result.err.find(" judges elsewhere"), std::string::npos) << failure << "\n" << result.err;
  }
}

// Each time that a rank asks for much: for an object that has come, the images of a task, what is to be written.
TEST_P(BrokenLinks, WithoutMemoryTheResultIsRightOrThereIsNone) {
  make_scan("scan.off", 100);
  const std::string spin = "spin scan.off --spin-points 900 --threads 1 --journal none -o ";
  ASSERT_EQ(alone(spin + "alone.npy").code, 0);
  for (const int rank : {0, 1}) {
    int request = 1;
    while (true) {
      fs::remove(dir_.path() / "ranks.npy");
      const std::string failure = fmt::format("{} memory {}", rank, request);
      const RunResult result = run_with(failure, spin + "ranks.npy");
      if (!has_come(failure)) {
        break;
      }
      if (fs::exists(dir_.path() / "ranks.npy")) {
        EXPECT_TRUE(bytes("ranks.npy") == bytes("alone.npy")) << failure << "\n" << result.err;
        EXPECT_NE(result.code, 1) << failure << "\n" << result.err;
      } else {
        EXPECT_NE(result.err.find("not enough memory"), std::string::npos) << failure << "\n" << result.err;
      }
      ++request;
    }
    EXPECT_GT(request, 1) << "rank " << rank << " asks for nothing";  // rank 1 for the images of its task alone
  }
}

TEST_P(BrokenLinks, ARankStoppedWhileMpiStartsEndsTheRunWithAWord) {
  const RunResult result = train_with("1 MPI_Init_thread 1");
  EXPECT_NE(result.err.find("spincat: a rank did not answer while MPI started; run the same command again to continue"),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(fs::exists(dir_.path() / "ranks.spincat"));
}

}  // namespace
}  // namespace spincat::test
