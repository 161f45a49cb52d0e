// What a farm does: many tasks of one kind, each bytes in and bytes out.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace spincat {

class Packer;

// Does one task. May be called by several threads at once. What it throws reaches the caller of the farm.
using Work = std::function<std::string(std::string_view task)>;

// What another rank than 0 does in a job.
struct RankWork {
  RankWork() = default;
  template <class Callable>
  requires std::convertible_to<Callable, Work> RankWork(Callable its_work)
      : work(std::move(its_work)) {}  // not explicit: most works keep nothing

  Work work;
  // Where later work needs the results: takes this rank's own, and those of the others where the job broadcasts
  // them (Job::broadcasts). Called by one thread, while others work. A task's result may come twice, and be the same.
  std::function<void(std::size_t task, std::string_view result)> keep;
};

// Packs what other ranks need.
using Context = std::function<void(Packer& packer)>;

// Tasks of one kind.
struct Job {
  std::string kind;  // by which other ranks know the work
  Context context;   // what they need for it
  Context identity;  // what its results depend on, by which the journal knows it; empty: the context is that
  Work work;         // the same work, here
  std::size_t tasks = 0;
  std::function<std::string(std::size_t task)> task;  // what is to be done, as bytes
  std::function<void(std::size_t task, std::string result)>
      deliver;             // on the calling thread, in the order of the tasks
  bool in_journal = true;  // false where results are large, or soon computed again
  std::function<bool(std::string_view result)> is_worth_keeping;  // in the journal; empty: every result is
  bool stays_here = false;                                        // for the threads of this process alone
  // Whether all results are broadcast as they come (RankWork::keep): every rank that takes part then knows them before
  // it hears of the next job. Asked with one result after the other until it says so; those for which it says nothing
  // are not broadcast. Empty: no.
  std::function<std::optional<bool>(std::string_view result)> broadcasts;
};

// Makes the work of a kind from what all its tasks need; may keep what later work needs. Called once a job on each
// rank but 0, by one thread.
using WorkFactory = std::function<RankWork(std::string_view kind, std::string_view context)>;

// What became of a task.
struct TaskResult {
  enum class Outcome : unsigned char { done, bad_input, failed };
  std::size_t task = 0;
  Outcome outcome = Outcome::done;
  std::string bytes;     // of a done task, else the problem
  std::string file;      // of a problem, where one is known
  double seconds = 0.0;  // spent on it

  // Throws what the work has thrown: InputError or RunError.
  void throw_problem() const;
};

}  // namespace spincat
