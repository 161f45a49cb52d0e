// Which tasks of a job are open, being done and done.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <vector>

namespace spincat {

// Hands out tasks in their order, to ranks that may be lost. Knows neither ranks' messages nor results.
class TaskQueue {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Seconds = std::chrono::duration<double>;

  // Of `tasks` tasks, at most `window` are handed out ahead of the first that was not delivered: so bounds the results
  // that wait for their turn.
  TaskQueue(std::size_t tasks, std::size_t window);

  void set_window(std::size_t window) { window_ = window; }
  bool all_delivered() const { return delivered_ == done_.size(); }
  std::size_t delivered() const { return delivered_; }
  bool is_done(std::size_t task) const { return done_[task]; }

  // The next task for a rank: one that was taken back from a lost rank, the next in order, or, where none is left, a
  // second copy of one that another rank has been at for longer than `patience`.
  std::optional<std::size_t> next_for(int rank, Time now, Seconds patience);

  // A result has come; true when it is the first of this task.
  bool finish(std::size_t task);

  // The result of the first task that was not delivered was handed on. Precondition: it is done.
  void deliver() { ++delivered_; }

  // Opens all tasks again that this rank alone had; how many these were.
  std::size_t take_back(int rank);

 private:
  struct Pending {
    Time since;
    std::vector<int> ranks;
  };

  std::optional<std::size_t> slow_one(int rank, Time now, Seconds patience) const;

  std::size_t window_;
  std::size_t delivered_ = 0;
  std::size_t next_ = 0;  // first task that was never handed out
  std::vector<bool> done_;
  std::deque<std::size_t> taken_back_;
  std::map<std::size_t, Pending> pending_;
};

}  // namespace spincat
