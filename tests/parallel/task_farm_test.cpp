#include "spincat/parallel/task_farm.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "parallel/thread_ranks.h"
#include "spincat/error.h"
#include "spincat/parallel/farm_messages.h"
#include "spincat/parallel/process_state.h"
#include "spincat/parallel/task_server.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::ThreadCommunicator;
using test::Wires;

// Squares numbers; negative ones fail.
std::string square(std::string_view context, std::string_view task) {
  const int n = std::stoi(std::string(task));
  if (n == -1) {
    throw InputError("chair.off", "is broken");
  }
  if (n == -2) {
    throw std::bad_alloc();
  }
  return fmt::format("{}{}", context, n * n);
}

// Several ranks as threads; the farm lives in the thread of the test.
class Ranks {
 public:
  explicit Ranks(int count, int threads_each = 1, const std::function<void()>& before_task = {})
      : wires_(std::make_shared<Wires>(count)), ranks_(wires_, 0), kept_(static_cast<std::size_t>(count)) {
    for (int r = 1; r < count; ++r) {
      const auto factory = [before_task, &kept = kept_[static_cast<std::size_t>(r)]](std::string_view kind,
                                                                                     std::string_view context) {
        if (kind != "square") {
          throw RunError("not known");
        }
        RankWork work = [before_task, ours = std::string(context)](std::string_view task) {
          if (before_task) {
            before_task();
          }
          return square(ours, task);
        };
        work.keep = [&kept](std::size_t task, std::string_view result) { kept[task] = result; };
        return work;
      };
      servers_.emplace_back([this, r, factory, threads_each] {
        ThreadCommunicator ranks(wires_, r);
        const ServiceEnd end = serve(ranks, factory, {[&](int) { return threads_each; }, [] {}, true});
        const std::lock_guard lock(ends_mutex_);
        ends_[r] = end;
      });
    }
  }

  ~Ranks() { join(); }

  void join() {
    for (std::thread& server : servers_) {
      if (server.joinable()) {
        server.join();
      }
    }
  }

  Communicator& communicator() { return ranks_; }
  // What a rank was to keep. Wait for the end of the farm first.
  const std::map<std::size_t, std::string>& kept(int rank) {
    servers_[static_cast<std::size_t>(rank) - 1].join();
    return kept_[static_cast<std::size_t>(rank)];
  }
  Wires& wires() { return *wires_; }

  // How those that have left did so.
  std::map<int, ServiceEnd> ends() {
    const std::lock_guard lock(ends_mutex_);
    return ends_;
  }

 private:
  std::shared_ptr<Wires> wires_;
  ThreadCommunicator ranks_;
  std::vector<std::map<std::size_t, std::string>> kept_;
  std::mutex ends_mutex_;
  std::map<int, ServiceEnd> ends_;
  std::vector<std::thread> servers_;
};

// Of silence, while this object lives.
class Deadline {
 public:
  explicit Deadline(const char* seconds) { setenv("SPINCAT_DEADLINE", seconds, 1); }
  ~Deadline() { unsetenv("SPINCAT_DEADLINE"); }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
};

struct Outcome {
  std::vector<std::string> results;
  std::vector<std::size_t> order;
};

Job squares(const std::vector<int>& numbers, Outcome& outcome) {
  Job job;
  job.kind = "square";
  job.context = [](Packer& packer) { packer.add_rest("="); };
  job.work = [](std::string_view task) { return square("=", task); };
  job.tasks = numbers.size();
  job.task = [&numbers](std::size_t i) { return std::to_string(numbers[i]); };
  job.deliver = [&outcome](std::size_t i, std::string result) {
    outcome.order.push_back(i);
    outcome.results.push_back(std::move(result));
  };
  return job;
}

std::vector<int> numbers_up_to(int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) {
    numbers.push_back(i);
  }
  return numbers;
}

void expect_squares(const Outcome& outcome, int count) {
  ASSERT_EQ(outcome.results.size(), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(outcome.order[static_cast<std::size_t>(i)], static_cast<std::size_t>(i));
    EXPECT_EQ(outcome.results[static_cast<std::size_t>(i)], fmt::format("={}", i * i));
  }
}

TEST(TaskFarm, DeliversInOrderWithAnyRanksAndThreads) {
  const std::vector<int> numbers = numbers_up_to(300);
  for (const auto& [ranks, threads] : std::vector<std::pair<int, int>>{{1, 1}, {1, 3}, {2, 1}, {3, 2}, {7, 1}}) {
    Ranks others(ranks, threads);
    Outcome outcome;
    TaskFarm farm(others.communicator());
    farm.use_threads(threads, threads);
    std::size_t last = 0;
    farm.run(squares(numbers, outcome), [&](std::size_t done) {
      EXPECT_GE(done, last);
      last = done;
    });
    EXPECT_EQ(last, 300U);
    expect_squares(outcome, 300);
    EXPECT_EQ(farm.report().ranks.size(), static_cast<std::size_t>(ranks));
    EXPECT_EQ(farm.report().handed_out_again, 0U);
  }
}

TEST(TaskFarm, NoTasksAreSoonDone) {
  Ranks others(3);
  Outcome outcome;
  TaskFarm farm(others.communicator());
  farm.run(squares({}, outcome));
  EXPECT_TRUE(outcome.results.empty());
}

TEST(TaskFarm, EveryRankTakesPart) {
  Ranks others(3, 1, [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
  Outcome outcome;
  const std::vector<int> numbers = numbers_up_to(200);
  TaskFarm farm(others.communicator());
  Job job = squares(numbers, outcome);
  job.work = [](std::string_view task) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return square("=", task);
  };
  farm.run(job);
  expect_squares(outcome, 200);
  for (const FarmReport::Rank& rank : farm.report().ranks) {
    EXPECT_EQ(rank.threads, 1);
    EXPECT_GT(rank.busy_seconds, 0.01);
  }
}

TEST(TaskFarm, TheFirstProblemInOrderIsThrownWhateverTheRanks) {
  for (const int ranks : {1, 2, 4}) {
    Ranks others(ranks);
    Outcome outcome;
    TaskFarm farm(others.communicator());
    std::vector<int> numbers = numbers_up_to(50);
    numbers[20] = -1;
    numbers[21] = -2;
    test::expect_error<InputError>([&] { farm.run(squares(numbers, outcome)); }, "chair.off: is broken");
    EXPECT_EQ(outcome.results.size(), 20U);
    numbers[20] = 20;
    outcome = {};
    test::expect_error<RunError>([&] { farm.run(squares(numbers, outcome)); }, "not enough memory");
    outcome = {};
    farm.run(squares(numbers = numbers_up_to(40), outcome));  // the farm is still good
    expect_squares(outcome, 40);
  }
}

TEST(TaskFarm, WhatDeliverAndTickThrowEndsTheJob) {
  Ranks others(3);
  TaskFarm farm(others.communicator());
  Outcome outcome;
  const std::vector<int> numbers = numbers_up_to(100);
  Job job = squares(numbers, outcome);
  job.deliver = [](std::size_t i, const std::string&) {
    if (i == 3) {
      throw RunError("disk full");
    }
  };
  test::expect_error<RunError>([&] { farm.run(job); }, "disk full");
  test::expect_error<RunError>(
      [&] { farm.run(squares(numbers, outcome), [](std::size_t) { throw RunError("interrupted"); }); }, "interrupted");
}

TEST(TaskFarm, ALostRankCostsNothingButTime) {
  const Deadline deadline("0.3");
  std::atomic<int> begun = 0;
  std::shared_ptr<Wires> wires;
  Ranks others(3, 1, [&] {
    if (++begun == 10) {
      wires->silence(1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  });
  wires = std::shared_ptr<Wires>(&others.wires(), [](Wires*) {});
  Outcome outcome;
  {
    TaskFarm farm(others.communicator());
    const std::vector<int> numbers = numbers_up_to(400);
    Job job = squares(numbers, outcome);
    job.work = [](std::string_view task) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return square("=", task);
    };
    farm.run(job);
    expect_squares(outcome, 400);
    EXPECT_GT(farm.report().handed_out_again, 0U);
    EXPECT_TRUE(farm.report().ranks[1].lost);
    EXPECT_FALSE(farm.report().ranks[2].lost);
    others.wires().silence(1, false);  // so that it can say good-bye
  }
}

TEST(TaskFarm, ARankThatIsCutOffIsDoneWithoutAndLeaves) {
  Ranks others(3, 1, [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
  Outcome outcome;
  TaskFarm farm(others.communicator());
  const std::vector<int> numbers = numbers_up_to(200);
  Job job = squares(numbers, outcome);
  job.deliver = [&, deliver = job.deliver](std::size_t i, std::string result) {
    deliver(i, std::move(result));
    if (i == 20) {
      others.wires().cut_off(1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  farm.run(job);
  expect_squares(outcome, 200);
  EXPECT_TRUE(farm.report().ranks[1].lost);
  EXPECT_FALSE(farm.report().ranks[2].lost);
  while (others.ends().empty()) {  // the other waits for the end of the farm
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(others.ends(), (std::map{std::pair{1, ServiceEnd::cut_off}}));
}

TEST(TaskFarm, NoRankLeavesBeforeAllAreDone) {
  std::atomic<int> begun = 0;
  std::atomic<bool> may_end = false;
  std::thread waits;
  Ranks others(3, 1, [&] {
    if (++begun == 1) {  // one rank has a task that nobody waits for any more
      while (!may_end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  });
  Outcome outcome;
  {
    TaskFarm farm(others.communicator());
    const std::vector<int> numbers = numbers_up_to(40);
    Job job = squares(numbers, outcome);
    job.work = [&](std::string_view task) {
      while (begun < 1) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return square("=", task);
    };
    farm.run(job);
    waits = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the other rank has been dismissed by now
      EXPECT_TRUE(others.ends().empty());
      may_end = true;
    });
  }
  waits.join();
  others.join();
  EXPECT_EQ(others.ends(), (std::map{std::pair{1, ServiceEnd::dismissed}, std::pair{2, ServiceEnd::dismissed}}));
}

TEST(TaskServer, StaysUntilAllAreDoneWhenItsWorkIsEnded) {
  const auto wires = std::make_shared<Wires>(2);
  std::atomic<bool> is_told = false;
  std::atomic<bool> has_left = false;
  std::thread server([&] {
    ThreadCommunicator ranks(wires, 1);
    const auto keep_going = [&] {
      is_told = true;
      throw RunError("interrupted");
    };
    const WorkFactory no_work = [](std::string_view, std::string_view) -> RankWork { throw RunError("not known"); };
    EXPECT_THROW(serve(ranks, no_work, {[](int) { return 1; }, keep_going}), RunError);
    has_left = true;
  });
  {
    ThreadCommunicator ranks(wires, 0);
    TaskFarm farm(ranks);
    Outcome outcome;
    const std::vector<int> numbers = numbers_up_to(20);
    while (!is_told) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    farm.run(squares(numbers, outcome));
    expect_squares(outcome, 20);
    EXPECT_FALSE(has_left);
  }
  server.join();
  EXPECT_TRUE(has_left);
}

TEST(TaskServer, LeavesWhenRank0SaysNothingMore) {
  const Deadline deadline("0.02");  // three seconds of patience
  Ranks others(2);
  const TaskFarm farm(others.communicator());
  std::this_thread::sleep_for(std::chrono::seconds(4));
  EXPECT_TRUE(others.ends().empty());  // it hears rank 0, which does nothing
  others.wires().silence(0);
  others.join();
  EXPECT_EQ(others.ends(), (std::map{std::pair{1, ServiceEnd::abandoned}}));
}

// A process that ends when this object does, unless it was killed before.
class Child {
 public:
  explicit Child(const std::function<void()>& body) : process_(fork()) {
    if (process_ == 0) {
      body();
      _exit(0);
    }
  }
  ~Child() { has_ended(true); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t process() const { return process_; }

  bool has_ended(bool at_once = false) {
    if (at_once && !ended_) {
      kill(process_, SIGKILL);
    }
    ended_ = ended_ || waitpid(process_, nullptr, at_once ? 0 : WNOHANG) == process_;
    return ended_;
  }

 private:
  pid_t process_;
  bool ended_ = false;
};

// A rank 1 that has said who it is, and nothing else.
class Introduced {
 public:
  explicit Introduced(const std::function<void(farm::Greeting& greeting)>& change) : own_(wires_, 0) {
    farm::Greeting greeting = farm::own_greeting();
    change(greeting);
    ThreadCommunicator(wires_, 1).send(0, farm::kHello, std::make_shared<const std::string>(pack(greeting)));
  }
  Communicator& communicator() { return own_; }
  Wires& wires() { return *wires_; }

 private:
  std::shared_ptr<Wires> wires_ = std::make_shared<Wires>(2);
  ThreadCommunicator own_;
};

// The number of a rank that has gone may be that of another process by now.
TEST(TaskFarm, KillsNoProcessOfAnotherProgram) {
  for (const bool is_ours : {false, true}) {
    Child child([&] {
      if (!is_ours) {
        execlp("sleep", "sleep", "100", nullptr);
      }
      pause();
    });
    while (runs_our_program(child.process()) != is_ours) {  // until it has become another one
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    {
      Introduced rank([&](farm::Greeting& greeting) { greeting.process = child.process(); });
      TaskFarm farm(rank.communicator());
      EXPECT_EQ(farm.report().ranks.size(), 2U);  // it is greeted
      rank.wires().cut_off(1);
    }
    for (int i = 0; i < (is_ours ? 5'000 : 50) && !child.has_ended(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(child.has_ended(), is_ours);
  }
}

TEST(TaskFarm, WaitsForNobodyWhoWentBeforeTheGreeting) {
  const Deadline deadline("100");  // ten of these
  Child child([] {});
  while (!child.has_ended()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Introduced rank([&](farm::Greeting& greeting) { greeting.process = child.process(); });
  const TaskFarm farm(rank.communicator());
}

TEST(TaskFarm, ARankOfAnotherVersionSpoilsNoResult) {
  const Deadline deadline("0.05");
  const auto change = [](farm::Greeting& greeting) {
    greeting.program = "spincat 0";
    greeting.process = 0;
  };
  {
    Introduced late(change);
    TaskFarm farm(late.communicator());
    EXPECT_EQ(farm.report().ranks.size(), 2U);
  }
  Introduced early(change);
  TaskFarm farm(early.communicator());
  Outcome outcome;
  const std::vector<int> numbers = numbers_up_to(20);
  test::expect_error<RunError>([&] { farm.run(squares(numbers, outcome)); },
                               "rank 1 runs spincat 0, rank 0 another version: all hosts need the same program");
}

TEST(FarmReport, ARankThatNeverSaidWhereItIsIsOnNoHost) {
  FarmReport report;
  report.ranks = {{"here", 2, 1.0, false, {}}, {"", 0, 0.0, true, {}}};
  report.seconds = 1.0;
  EXPECT_EQ(report.text(), "2 ranks on 1 host, 2 threads: busy 50% lost; nothing handed out again");
}

TEST(TaskFarm, WhoSpeaksAgainTakesPartAgain) {
  const Deadline deadline("0.05");
  std::atomic<int> begun = 0;
  Ranks others(2, 1, [&] { ++begun; });
  Outcome outcome;
  TaskFarm farm(others.communicator());
  const std::vector<int> numbers = numbers_up_to(2'000);
  Job job = squares(numbers, outcome);
  int at_return = -1;
  job.deliver = [&](std::size_t i, std::string result) {
    outcome.order.push_back(i);
    outcome.results.push_back(std::move(result));
    if (i == 100) {
      others.wires().silence(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (i == 300) {
      others.wires().silence(1, false);
      at_return = begun;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  };
  farm.run(job);
  expect_squares(outcome, 2'000);
  ASSERT_GE(at_return, 0);
  EXPECT_GT(begun, at_return);
  EXPECT_GT(farm.report().handed_out_again, 0U);
}

// Jobs that are shorter than the deadline, one after the other.
TEST(TaskFarm, NothingPilesUpForASilentRank) {
  const Deadline deadline("0.1");
  const auto wires = std::make_shared<Wires>(2);  // nobody plays rank 1
  ThreadCommunicator own(wires, 0);
  TaskFarm farm(own);
  const std::vector<int> numbers = numbers_up_to(2);
  for (int round = 0; round < 120; ++round) {
    Outcome outcome;
    Job job = squares(numbers, outcome);
    job.context = [](Packer& packer) { packer.add_rest(std::string(1 << 20, ' ')); };
    job.work = [](std::string_view task) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return square("=", task);
    };
    farm.run(job);
    expect_squares(outcome, 2);
    farm.broadcast("square", job.context);
  }
  EXPECT_TRUE(farm.report().ranks[1].lost);
  EXPECT_LT(wires->bytes_to(1), std::size_t{120} << 20);  // of 240 MB
}

TEST(TaskFarm, WhoTakesNothingIsDoneWithoutUntilItDoes) {
  Ranks others(2);
  TaskFarm farm(others.communicator(), {.most_ranks_to_work_beside = 0, .counts_remote_tasks = true});
  const std::vector<int> numbers = numbers_up_to(20);
  for (const bool is_slow : {true, false}) {
    others.wires().slow_down(1, is_slow ? std::size_t{2} << 30 : 0);
    Outcome outcome;
    farm.run(squares(numbers, outcome));
    expect_squares(outcome, 20);
    EXPECT_EQ(farm.report().remote_tasks["square"], is_slow ? 0U : 20U);
    EXPECT_EQ(farm.report().ranks[1].refusal, "it does not take what it is sent");
  }
}

TEST(TaskFarm, ARankThatCannotDoTheWorkIsDoneWithout) {
  const Deadline deadline("0.05");  // it says nothing more, and is not lost
  Ranks others(3);
  TaskFarm farm(others.communicator());
  Outcome outcome;
  const std::vector<int> numbers = numbers_up_to(50);
  Job job = squares(numbers, outcome);
  job.kind = "something else";
  job.work = [](std::string_view task) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return square("=", task);
  };
  farm.run(job);
  expect_squares(outcome, 50);
  const FarmReport report = farm.report();
  for (const std::size_t rank : {1U, 2U}) {
    EXPECT_FALSE(report.ranks[rank].lost);
    EXPECT_EQ(report.ranks[rank].refusal, "not known");
  }
  EXPECT_NE(report.text().find("; rank 1 could not take part: not known"), std::string::npos) << report.text();
}

// Its host may lack what ours has.
TEST(TaskFarm, WhatAnotherRankCannotDoIsDoneHere) {
  for (const bool memory : {false, true}) {
    Ranks others(3, 1, [memory] {
      if (memory) {
        throw std::bad_alloc();
      }
      throw InputError("no such file");
    });
    TaskFarm farm(others.communicator());
    Outcome outcome;
    const std::vector<int> numbers = numbers_up_to(100);
    farm.run(squares(numbers, outcome));
    expect_squares(outcome, 100);
  }
}

TEST(TaskFarm, TellsAllRanksWhatAnyHasFound) {
  const std::vector<int> numbers = numbers_up_to(100);
  const test::TempDir dir;
  for (const int round : {0, 1}) {  // the second time from the journal
    Ranks others(4, 1, [] { std::this_thread::sleep_for(std::chrono::microseconds(200)); });
    {
      Journal journal(dir.path() / "j", {"settings", "data"});
      Outcome outcome;
      TaskFarm farm(others.communicator());
      farm.use_journal(&journal);
      Job job = squares(numbers, outcome);
      job.broadcasts = [](std::string_view result) { return result.empty() ? std::nullopt : std::optional(true); };
      farm.run(job);
      expect_squares(outcome, 100);
      EXPECT_EQ(farm.report().resumed, round == 0 ? 0U : 100U);
    }
    for (const int rank : {1, 2, 3}) {
      const auto& kept = others.kept(rank);
      ASSERT_EQ(kept.count(0), 1U) << rank;
      for (const auto& [task, result] : kept) {
        EXPECT_EQ(result, fmt::format("={}", task * task));
      }
      EXPECT_EQ(kept.size(), 100U) << rank;
    }
  }
}

TEST(TaskFarm, TellsNobodyWhatIsNotWanted) {
  Ranks others(3);
  {
    Outcome outcome;
    const std::vector<int> numbers = numbers_up_to(50);
    TaskFarm farm(others.communicator());
    Job job = squares(numbers, outcome);
    job.broadcasts = [](std::string_view) { return false; };
    farm.run(job);
    expect_squares(outcome, 50);
  }
  EXPECT_LE(others.kept(1).size() + others.kept(2).size(), 50U);  // each at most what it has found itself
}

// No file becomes longer than this, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

TEST(TaskFarm, AJournalNobodyAskedForMayFail) {
  const test::TempDir dir;
  const std::vector<int> numbers = numbers_up_to(60);
  Journal journal(dir.path() / "j", {"settings", "data"});
  int told = 0;
  for (const bool is_asked_for : {false, true}) {
    LocalFarm own(2);
    const FileSizeLimit limit(1'000);
    own.farm().use_journal(
        &journal, is_asked_for ? std::function<void(const RunError&)>() : [&](const RunError&) { ++told; });
    for (const int round : {0, 1}) {
      Outcome outcome;
      if (is_asked_for) {
        test::expect_error<RunError>([&] { own.farm().run(squares(numbers, outcome)); }, "cannot write: ");
      } else {
        own.farm().run(squares(numbers, outcome));
        expect_squares(outcome, 60);
      }
      EXPECT_EQ(told, 1) << round;
    }
    EXPECT_GT(journal.size(), 0U);
    EXPECT_LT(journal.size(), 60U);
  }
}

TEST(TaskFarm, GoesOnWhereTheJournalEnds) {
  const test::TempDir dir;
  const RunIdentity identity{"settings", "data"};
  const std::vector<int> numbers = numbers_up_to(60);
  Outcome first;
  {
    Journal journal(dir.path() / "j", identity);
    SerialCommunicator alone;
    TaskFarm farm(alone);
    farm.use_journal(&journal);
    const auto stop = [&](std::size_t done) {
      if (done >= 25) {
        throw RunError("killed");
      }
    };
    test::expect_error<RunError>([&] { farm.run(squares(numbers, first), stop); }, "killed");
  }
  Journal journal(dir.path() / "j", identity);
  EXPECT_GE(journal.size(), 25U);
  EXPECT_LT(journal.size(), 60U);
  const std::size_t had = journal.size();
  Ranks others(3);
  Outcome second;
  TaskFarm farm(others.communicator());
  farm.use_journal(&journal);
  farm.run(squares(numbers, second));
  expect_squares(second, 60);
  EXPECT_EQ(farm.report().resumed, had);
  {  // the same run, but what stands at the first job's place is another one of as many tasks
    Journal other(dir.path() / "k", identity);
    SerialCommunicator alone;
    for (const int shift : {0, 1}) {
      TaskFarm farm_again(alone);
      farm_again.use_journal(&other);
      std::vector<int> shifted = numbers;
      shifted[30] += shift;
      Outcome found;
      farm_again.run(squares(shifted, found));
      EXPECT_EQ(found.results[30], fmt::format("={}", shifted[30] * shifted[30]));
      EXPECT_EQ(farm_again.report().resumed, 0U);
    }
  }
  Outcome again;  // another job of the same run: not the first one's results
  farm.run(squares(numbers, again));
  expect_squares(again, 60);
  EXPECT_EQ(farm.report().resumed, had);
}

}  // namespace
}  // namespace spincat
