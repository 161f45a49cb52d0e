// The task farm: many tasks, done by the threads of this process and by other ranks, results in the order of the tasks.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "spincat/parallel/communicator.h"
#include "spincat/parallel/farm_report.h"
#include "spincat/parallel/journal.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/placement.h"
#include "spincat/parallel/task.h"

namespace spincat {

class Heartbeat;

// How far other ranks are drawn into the work. The results do not depend on it.
struct FarmPolicy {
  int most_ranks_to_work_beside = 32;  // with more, rank 0 has enough to do with handing out and delivering
  double gain_of_broadcast = 2.0;      // seconds that one second of sending must save all ranks to be worth it
  bool counts_remote_tasks = false;    // FarmReport::remote_tasks
};

// Rank 0's side of the farm; the other ranks serve (task_server.h). A rank that says nothing for longer than the
// deadline is taken to be lost: its tasks are handed out again, and the first result of a task counts. When it speaks
// again it takes part again, but for jobs that need what it has missed: what a rank does not take is not piled up for
// it. The results do not depend on the number of threads and ranks, nor on losses. For one thread of rank 0.
class TaskFarm {
 public:
  using Clock = std::chrono::steady_clock;
  // Called with the number of tasks delivered, at least some ten times a second. What it throws ends the job cleanly.
  using Tick = std::function<void(std::size_t delivered)>;

  explicit TaskFarm(Communicator& ranks, const FarmPolicy& policy = {});
  // Tells the other ranks that this was all, and waits for those that are not lost. Ranks of this host that are stopped
  // are killed: a launcher would wait for them for ever.
  ~TaskFarm();
  TaskFarm(const TaskFarm&) = delete;
  TaskFarm& operator=(const TaskFarm&) = delete;

  int ranks() const { return ranks_.size(); }
  Placement placement() const { return placement_of(ranks_); }
  std::string mpi() const { return ranks_.implementation(); }

  // Threads of this process, and as many as the user asked for on other ranks (0: as many as there are).
  void use_threads(int here, int requested);
  int threads() const { return threads_; }
  // Whether there is more to a job than this process's threads: other ranks, or a journal.
  bool is_distributed() const { return ranks() > 1 || journal_ != nullptr; }

  std::size_t resumed() const { return resumed_; }  // tasks that the journal had, so far

  const FarmPolicy& policy() const { return policy_; }
  int threads_everywhere() const;  // as far as known: ranks that have not spoken yet count like this one

  // From now on results are kept in the journal, and those that it has are not computed again. Null: no journal. Where
  // there is a `tell_failure`, a journal that can no longer be written ends no job: it is called once, and nothing more
  // is kept.
  void use_journal(Journal* journal, std::function<void(const RunError& problem)> tell_failure = {});

  // Does all tasks. Throws what `deliver` and `tick` throw, and the problem of the first task, in their order, that has
  // one (InputError or RunError).
  void run(const Job& job, const Tick& tick = {});

  // Gives all other ranks something that later jobs need. No tasks.
  void broadcast(const std::string& kind, const Context& context);

  // So far. Waits a moment for ranks that have not even said where they are: jobs may be over before.
  FarmReport report();

 private:
  class Run;
  struct Rank;

  SharedBytes start_of(std::uint32_t job, const std::string& kind, const Context& context) const;
  void greet(Rank& rank, const Message& message);
  void greet_late(Rank& rank, const Message& message);
  void say_to_all(int tag, const SharedBytes& bytes);
  bool tell(std::size_t other, int tag, const SharedBytes& bytes);
  void ask(std::size_t other, const SharedBytes& job);
  void dismiss();

  Communicator& ranks_;
  const FarmPolicy policy_;
  std::unique_ptr<Heartbeat> heartbeat_;  // null where there is no other rank
  int threads_ = 1;
  int requested_threads_ = 1;
  Journal* journal_ = nullptr;
  bool journal_is_full_ = false;
  std::function<void(const RunError& problem)> tell_journal_failure_;
  std::uint32_t job_ = 0;
  std::uint64_t journaled_jobs_ = 0;
  std::vector<Rank> others_;                    // ranks 1, 2, ...
  Clock::time_point last_look_ = Clock::now();  // at who is silent
  double busy_here_ = 0.0;
  double seconds_ = 0.0;
  std::size_t handed_out_again_ = 0;
  std::size_t resumed_ = 0;
  std::map<std::string, std::size_t> remote_tasks_;  // by their kind; where the policy counts them
};

// How long a rank may say nothing before it is taken to be lost: ten times the time between two signs of life. The
// environment variable SPINCAT_DEADLINE gives another, in seconds.
std::chrono::duration<double> silence_deadline();

// A farm of this process's threads alone.
class LocalFarm {
 public:
  explicit LocalFarm(int threads) : farm_(alone_) { farm_.use_threads(threads, threads); }
  TaskFarm& farm() { return farm_; }

 private:
  SerialCommunicator alone_;
  TaskFarm farm_;
};

}  // namespace spincat
