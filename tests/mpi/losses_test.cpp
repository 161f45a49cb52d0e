// Ranks that are killed or stopped at random moments, of one dense object and of a training. SPINCAT_LOSSES says how
// often each is tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <random>

#include "mpi/launching.h"

namespace spincat::test {
namespace {

struct Task {
  std::string name;
  std::string arguments;
  std::string extension;  // of its result
};

std::ostream& operator<<(std::ostream& stream, const Task& task) {
  return stream << task.name;
}

class Losses : public Launching, public testing::WithParamInterface<Task> {
 protected:
  void SetUp() override {
    make_scan("scan.off", 40);
    make_dataset(20);
    ASSERT_EQ(alone(GetParam().arguments + " -o " + alone_).code, 0);
  }

  static int rounds() {
    const char* wanted = std::getenv("SPINCAT_LOSSES");
    return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 1;
  }

  // Starts the command in the background; its exit code appears in a file.
  void start(const Mpi& mpi, int ranks) {
    fs::remove(dir_.path() / "code");
    fs::remove(dir_.path() / ranks_);
    const std::string line = fmt::format(
        "cd '{}' && (SPINCAT_DEADLINE=1 timeout -v -k 1 60 {} {} -n {} '{}' {} -o {} >.out 2>.err "
        "</dev/null; echo $? >code.new; mv code.new code) >/dev/null 2>&1 &",
        dir_.path().string(), mpi.launcher, mpi.recovery, ranks, SPINCAT_COMMAND, GetParam().arguments, ranks_);
    ASSERT_EQ(std::system(line.c_str()), 0);
  }

  // Process numbers of our ranks: of the first, or of all others.
  std::vector<pid_t> processes(bool of_first) const {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) {
        continue;
      }
      std::error_code error;
      const fs::path folder = fs::read_symlink(entry.path() / "cwd", error);
      const fs::path program = fs::read_symlink(entry.path() / "exe", error);
      const std::string environment = contents(entry.path() / "environ");
      const auto has = [&](const char* variable) { return environment.find(variable) != std::string::npos; };
      if (folder == fs::canonical(dir_.path()) && program == fs::canonical(SPINCAT_COMMAND) &&
          (has("PMI_RANK=") || has("OMPI_COMM_WORLD_RANK=")) &&
          (has("PMI_RANK=0") || has("OMPI_COMM_WORLD_RANK=0")) == of_first) {
        found.push_back(std::stoi(name));
      }
    }
    return found;
  }

  // Sends a signal to a worker at a random moment after two were seen, `latest` at the latest; false when it had ended.
  // Not at once: where a process goes before it has found its launcher, Open MPI's may hang.
  bool hit(int signal, std::chrono::milliseconds latest) {
    std::vector<pid_t> found;
    for (int i = 0; i < 2'000 && found.size() < 2 && !fs::exists(dir_.path() / "code"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      found = processes(false);
    }
    std::uniform_int_distribution<std::int64_t> moment(kEarliest.count(), latest.count());
    std::this_thread::sleep_for(std::chrono::milliseconds(moment(random_)));
    if (found.empty()) {
      return false;
    }
    const pid_t worker = found[random_() % found.size()];
    return is_running(worker) && kill(worker, signal) == 0;
  }

  // Starts the command until the signal found a worker: a run may end before it is sent.
  void start_and_hit(const Mpi& mpi, int ranks, int signal) {
    using namespace std::chrono_literals;
    for (std::chrono::milliseconds latest = 1'500ms; latest > kEarliest; latest /= 2) {
      start(mpi, ranks);
      if (hit(signal, latest)) {
        return;
      }
      EXPECT_EQ(wait_for_code(), 0) << bytes(".err");
    }
    FAIL() << "no signal came in time";
  }

  // Neither gone nor a zombie.
  static bool is_running(pid_t process) {
    const std::string stat = contents(fmt::format("/proc/{}/stat", process));
    const std::size_t name_end = stat.rfind(") ");
    return name_end != std::string::npos && stat[name_end + 2] != 'Z';
  }

  int wait_for_code() const {
    for (int i = 0; i < 7'000 && !fs::exists(dir_.path() / "code"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const std::string code = contents(dir_.path() / "code");
    return code.empty() ? -1 : std::stoi(code);
  }

  // In our words, or in those of Open MPI, which may notice before we do.
  bool failed_to_start() const {
    const std::string words = bytes(".err");
    return words.find("while MPI started") != std::string::npos || words.find("MPI_Init") != std::string::npos;
  }

  void expect_right() { EXPECT_TRUE(bytes(ranks_) == bytes(alone_)) << bytes(".err"); }

  static constexpr std::chrono::milliseconds kEarliest{50};
  const std::string alone_ = "alone" + GetParam().extension;
  const std::string ranks_ = "ranks" + GetParam().extension;
  std::mt19937 random_{std::random_device{}()};
};

// Nobody goes on without rank 0, nor stays: the same command goes on from the journal.
class LossOfTheFirst : public Losses {
 protected:
  void expect_end_and_resume(const Mpi& mpi) {
    start(mpi, 3);
    std::vector<pid_t> first;
    while (first.empty() && !fs::exists(dir_.path() / "code")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      // Not before it has something to lose.
      first = fs::exists(dir_.path() / (ranks_ + ".journal")) ? processes(true) : std::vector<pid_t>();
    }
    const bool killed = !first.empty() && kill(first.front(), SIGKILL) == 0;
    int code = wait_for_code();
    EXPECT_EQ(bytes(".err").find("timeout: sending signal"), std::string::npos) << "does not end\n" << bytes(".err");
    for (int i = 0; i < 500 && !processes(false).empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(processes(false).empty());
    if (killed) {
      start(mpi, 3);
      code = wait_for_code();
    }
    EXPECT_EQ(code, 0) << bytes(".err");
    expect_right();
  }
};

// But for a rank that is lost while MPI itself starts: nothing is done yet, and the command says so. The exit code
// tells little, as Open MPI's recovery makes it 0 in any case: what counts are the bytes, and that the run ends.
TEST_P(Losses, UnderOpenMpiCostNothingButTime) {
  if (const std::string reason = reason_to_skip(kOpenMpi); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  int failed = 0;
  for (const int signal : {SIGKILL, SIGSTOP}) {
    for (int round = 0; round < rounds(); ++round) {
      start_and_hit(kOpenMpi, 3, signal);
      int code = wait_for_code();
      if (failed_to_start()) {
        ASSERT_LT(++failed, rounds() + 10) << "no run starts";
        EXPECT_FALSE(fs::exists(dir_.path() / ranks_)) << bytes(".err");
        start(kOpenMpi, 3);
        code = wait_for_code();
        --round;  // does not count
      }
      EXPECT_EQ(code, 0) << "signal " << signal << ", round " << round << "\n" << bytes(".err");
      expect_right();
    }
  }
}

TEST_P(LossOfTheFirst, EndsTheRunUnderOpenMpi) {
  if (const std::string reason = reason_to_skip(kOpenMpi); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  expect_end_and_resume(kOpenMpi);
}

TEST_P(LossOfTheFirst, EndsTheRunUnderMpich) {
  if (const std::string reason = reason_to_skip(kMpich); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  expect_end_and_resume(kMpich);
}

// MPICH's launcher ends the whole run; the same command goes on from the journal.
TEST_P(Losses, UnderMpichTheSameCommandGoesOn) {
  if (const std::string reason = reason_to_skip(kMpich); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  for (const int signal : {SIGKILL, SIGSTOP}) {
    for (int round = 0; round < rounds(); ++round) {
      start_and_hit(kMpich, 3, signal);
      if (wait_for_code() != 0) {
        start(kMpich, 3);
        EXPECT_EQ(wait_for_code(), 0) << "signal " << signal << ", round " << round << "\n" << bytes(".err");
      }
      expect_right();
      EXPECT_FALSE(fs::exists(dir_.path() / (ranks_ + ".journal")));
    }
  }
}

const Task kSpin{"spin", "spin scan.off --image-width 32 --threads 1", ".npy"};
const Task kTrain{"train", "train boxes --threads 1 --copies 2 --background 40", ".spincat"};
const auto kName = [](const auto& task) { return task.param.name; };

INSTANTIATE_TEST_SUITE_P(Tasks, LossOfTheFirst, testing::Values(kSpin, kTrain), kName);
INSTANTIATE_TEST_SUITE_P(
    Tasks, Losses,
    testing::Values(kSpin, kTrain,
                    Task{"images", "train boxes --divide images --copies 1 --background 8 --threads 1", ".spincat"},
                    Task{"dense", "train boxes --spin-points 4096 --copies 1 --background 8 --threads 1", ".spincat"}),
    kName);

}  // namespace
}  // namespace spincat::test
