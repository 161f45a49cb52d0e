// The command under mpirun: the same files as without, whatever the MPI, the ranks and the threads.
#include <gtest/gtest.h>
#include <sched.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "mpi/launching.h"
#include "support/lasting_part.h"

namespace spincat::test {
namespace {

using Json = nlohmann::json;

class UnderMpi : public Launching, public testing::WithParamInterface<Mpi> {
 protected:
  void SetUp() override {
    if (const std::string reason = reason_to_skip(GetParam()); !reason.empty()) {
      GTEST_SKIP() << reason;
    }
  }

  // Runs a command on so many ranks and asserts that it did.
  RunResult run(int ranks, const std::string& arguments, const std::string& environment = "") {
    RunResult result = launch(GetParam(), ranks, arguments, environment);
    EXPECT_EQ(result.code, 0) << result.err;
    if (ranks > 1) {
      EXPECT_NE(result.err.find(fmt::format("spincat: {} ranks on 1 host", ranks)), std::string::npos) << result.err;
      EXPECT_NE(result.err.find("nothing handed out again"), std::string::npos) << result.err;
    }
    return result;
  }

  // The same where the other ranks do all of these tasks.
  RunResult run_elsewhere(int ranks, const std::string& arguments, const std::vector<std::string>& kinds) {
    RunResult result = run(ranks, arguments, kShareAlways);
    for (const std::string& kind : kinds) {
      EXPECT_NE(result.err.find(kind + " elsewhere"), std::string::npos) << result.err;
    }
    EXPECT_EQ(result.err.find("could not take part"), std::string::npos) << result.err;
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(Mpi, UnderMpi, testing::Values(kOpenMpi, kMpich),
                         [](const auto& each) { return each.param.name; });

TEST_P(UnderMpi, SpinImagesAreTheSameBytes) {
  make_scan("scan.off", 30);
  ASSERT_EQ(alone("spin scan.off -o alone.npy --image-width 16").code, 0);
  const std::string expected = bytes("alone.npy");
  ASSERT_GT(expected.size(), 1'800U * 256U * 4U);
  for (const auto& [ranks, threads] : std::vector<std::pair<int, int>>{{1, 1}, {2, 1}, {3, 2}, {4, 1}, {7, 1}}) {
    run(ranks, fmt::format("spin scan.off -o ranks.npy --image-width 16 --threads {}", threads));
    EXPECT_TRUE(bytes("ranks.npy") == expected) << ranks << " ranks";
    fs::remove(dir_.path() / "ranks.npy");
  }
  EXPECT_FALSE(fs::exists(dir_.path() / "ranks.npy.journal"));
}

TEST_P(UnderMpi, BothDivisionsGiveTheSameFeatures) {
  make_scan("scan.off", 40);
  const std::string settings = "--points 4096 --spin-points 4096 --image-width 16 --bin-size 0.1rel ";
  ASSERT_EQ(alone("describe scan.off -o alone.npy " + settings).code, 0);
  const std::string expected = bytes("alone.npy");
  ASSERT_GT(expected.size(), 1'000U);
  for (const int ranks : {1, 2, 3}) {
    for (const char* divide : {"sums", "images"}) {
      run(ranks, fmt::format("describe scan.off -o ranks.npy {} --divide {}", settings, divide));
      EXPECT_TRUE(bytes("ranks.npy") == expected) << ranks << " ranks, " << divide;
    }
  }
}

TEST_P(UnderMpi, ModelsAreTheSameBytes) {
  make_dataset(5);
  const std::string small = "--copies 1 --background 8 --points 256 --spin-points 32 ";
  ASSERT_EQ(alone("train boxes -o alone.spincat " + small).code, 0);
  const std::string expected = bytes("alone.spincat");
  ASSERT_GT(expected.size(), 1'000U);
  for (const int ranks : {1, 2, 3, 4}) {
    run(ranks, "train boxes -o ranks.spincat --threads 1 " + small);
    EXPECT_TRUE(bytes("ranks.spincat") == expected) << ranks << " ranks";
  }
  run(2, "train boxes -o ranks.spincat --divide images " + small);
  EXPECT_TRUE(bytes("ranks.spincat") == expected) << "images";
}

TEST_P(UnderMpi, ModelsThatOtherRanksTrainAreTheSameBytes) {
  make_dataset(5);
  for (const std::string kernel : {"linear", "rbf"}) {
    const std::string small = "--threads 1 --copies 1 --points 256 --spin-points 32 --kernel " + kernel +
                              (kernel == "linear" ? " --background 8" : "");
    ASSERT_EQ(alone("train boxes -o alone.spincat " + small).code, 0);
    for (const int ranks : kernel == "linear" ? std::vector<int>{2, 3, 4, 7} : std::vector<int>{3}) {
      run_elsewhere(ranks, "train boxes -o ranks.spincat " + small,
                    {" 15 feature vectors of objects", " inner products", " judges"});
      EXPECT_TRUE(bytes("ranks.spincat") == bytes("alone.spincat")) << ranks << " ranks, " << kernel;
    }
  }
}

TEST_P(UnderMpi, EvaluationsAndNamesAreTheSame) {
  make_dataset(5);
  const std::string small = " --copies 1 --background 8 --points 256 --spin-points 32";
  const auto without_times = [](const std::string& text) {
    std::string kept;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      Json json = Json::parse(line);
      for (const char* key : {"seconds", "stage_seconds", "milliseconds", "mpi"}) {
        json.erase(key);
      }
      kept += json.dump() + "\n";
    }
    return kept;
  };
  ASSERT_EQ(alone("train boxes -o boxes.spincat" + small).code, 0);
  const std::string evaluate = "evaluate boxes --splits 3 --json" + small;
  const std::string classify = "classify boxes.spincat boxes --json --votes --report page.html";
  const std::string evaluation = without_times(alone(evaluate).out);
  const std::string names = without_times(alone(classify).out);
  ASSERT_NE(names, "");
  const std::string page = lasting_part(bytes("page.html"));
  for (const int ranks : {2, 3}) {
    EXPECT_EQ(without_times(run(ranks, evaluate).out), evaluation);
    EXPECT_EQ(without_times(run(ranks, classify).out), names);
    EXPECT_TRUE(lasting_part(bytes("page.html")) == page) << ranks << " ranks";
  }
  for (const int ranks : {2, 3, 4}) {
    const RunResult shared = run_elsewhere(ranks, evaluate, {" 15 feature vectors of objects", " 3 splits"});
    EXPECT_EQ(without_times(shared.out), evaluation) << ranks << " ranks";
  }
}

// The second point's judges are trained on the table that the ranks have.
TEST_P(UnderMpi, SweepsAreTheSame) {
  make_dataset(5);
  const std::string sweep =
      "sweep boxes --splits 2 --vary c=3,300 --threads 1 --copies 1 --points 256 --spin-points 32";
  const auto rates = [](const std::string& text) {
    Json points = Json::parse(text)["points"];
    for (Json& point : points) {
      for (const char* key : {"seconds", "stage_seconds"}) {
        point.erase(key);
      }
    }
    return points.dump();
  };
  const std::string expected = rates(alone(sweep + " --json").out);
  EXPECT_EQ(rates(run_elsewhere(3, sweep + " --json", {" 15 feature vectors of objects", " 4 splits"}).out), expected);
}

TEST_P(UnderMpi, OnlyOneRankSpeaks) {
  const RunResult wrong = launch(GetParam(), 3, "spin absent.off -o images.npy");
  EXPECT_NE(wrong.code, 0);
  EXPECT_NE(wrong.err.find("spincat: absent.off: no such file\n"), std::string::npos) << wrong.err;
  EXPECT_EQ(wrong.err.find("absent.off"), wrong.err.rfind("absent.off")) << wrong.err;
  EXPECT_EQ(launch(GetParam(), 2, "--version").out.substr(0, 8), "spincat ");
  make_scan("scan.off", 6);
  EXPECT_EQ(launch(GetParam(), 2, "spin scan.off -o images.npy --quiet").err, "");
}

TEST_P(UnderMpi, WarnsOfMoreThreadsThanProcessors) {
  make_scan("scan.off", 6);
  const RunResult result = run(2, "spin scan.off -o images.npy --threads 999");
  EXPECT_NE(result.err.find("2 ranks of 999 threads share the "), std::string::npos) << result.err;
}

// As in a container or a batch job that may use a part of the machine.
TEST_P(UnderMpi, RanksShareTheProcessorsThatAllAreBoundTo) {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0 || CPU_COUNT(&allowed) < 2) {
    GTEST_SKIP() << "there is only one processor";
  }
  make_scan("scan.off", 6);
  int first = 0;
  while (!CPU_ISSET(first, &allowed)) {
    ++first;
  }
  const RunResult result =
      launch(GetParam(), 2, "spin scan.off -o images.npy", fmt::format("{} taskset -c {}", kShareAlways, first));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("2 ranks of 1 thread share the 1 processor that the launcher has bound them to"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("2 ranks on 1 host, 2 threads"), std::string::npos) << result.err;
}

TEST_P(UnderMpi, AJournalThatNobodyAskedForMayFail) {
  make_scan("scan.off", 6);
  fs::create_directory(dir_.path() / "images.npy.journal");
  const RunResult result = run(2, "spin scan.off -o images.npy");
  EXPECT_NE(result.err.find("spincat: images.npy.journal: cannot write: is a directory; going on without a journal\n"),
            std::string::npos)
      << result.err;
  EXPECT_NE(launch(GetParam(), 2, "spin scan.off -o images.npy --journal images.npy.journal").code, 0);
}

class Singletons : public Launching {};

// A launcher that speaks to another MPI starts processes that each believe to be alone.
TEST_F(Singletons, AreRefused) {
  make_scan("scan.off", 6);
  const std::string spin = fmt::format("'{}' spin scan.off -o images.npy", SPINCAT_COMMAND);
  if (const std::string reason = reason_to_skip(kMpich); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  const RunResult other = shell(spin, "PMI_SIZE=2 PMI_RANK=0");
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("has started 2 processes, but each of them is alone"), std::string::npos) << other.err;
  EXPECT_FALSE(fs::exists(dir_.path() / "images.npy"));
}

TEST_F(Singletons, OfSrunAreToldWhatToDo) {
  make_scan("scan.off", 6);
  const std::string spin = fmt::format("'{}' spin scan.off -o images.npy", SPINCAT_COMMAND);
  const RunResult first = shell(spin, "SLURM_STEP_NUM_TASKS=4 SLURM_PROCID=0");
  EXPECT_EQ(first.code, 1);
  EXPECT_NE(first.err.find("srun has started 4 processes"), std::string::npos) << first.err;
  EXPECT_NE(first.err.find("--mpi=pmix"), std::string::npos) << first.err;
  const RunResult second = shell(spin, "SLURM_STEP_NUM_TASKS=4 SLURM_PROCID=1");
  EXPECT_EQ(second.code, 1);
  EXPECT_EQ(second.err, "");  // once is enough
  EXPECT_FALSE(fs::exists(dir_.path() / "images.npy"));
}

TEST_F(Singletons, OneProcessNeedsNoMpi) {
  make_scan("scan.off", 6);
  const RunResult result =
      shell(fmt::format("'{}' spin scan.off -o images.npy", SPINCAT_COMMAND), "SLURM_STEP_NUM_TASKS=1 SLURM_PROCID=0");
  EXPECT_EQ(result.code, 0) << result.err;
}

class Journals : public Launching {};

TEST_F(Journals, TellHowMuchOfThemWasOfUse) {
  make_scan("scan.off", 32);
  const std::string spin = "spin scan.off -o images.npy --image-width 16 --threads 1 --journal run.journal";
  // Four tasks of half a megabyte.
  const RunResult ended = shell(fmt::format("'{}' {}", SPINCAT_COMMAND, spin), "prlimit --fsize=1200000");
  EXPECT_NE(ended.code, 0);
  const RunResult again = alone(spin);
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("spincat: run.journal: has 2 finished tasks\n"), std::string::npos) << again.err;
  EXPECT_NE(again.err.find("spincat: run.journal: 2 of 2 finished tasks were of use\n"), std::string::npos)
      << again.err;
}

TEST_F(Journals, OfAnotherRunAreRefused) {
  make_scan("scan.off", 8);
  const std::string spin = "spin scan.off -o images.npy --journal run.journal ";
  EXPECT_EQ(alone(spin).code, 0);
  EXPECT_FALSE(fs::exists(dir_.path() / "run.journal"));  // it was complete
  dir_.write("run.journal", "something else, and long enough to be no journal that was torn off at its very beginning");
  const RunResult result = alone(spin);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "spincat: run.journal: is no journal of spincat\n");
}

}  // namespace
}  // namespace spincat::test
