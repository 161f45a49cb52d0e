// The threads of one rank that do a farm's tasks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "spincat/parallel/task.h"

namespace spincat {

// Threads that wait for tasks. All functions are for one thread, the owner's.
class ThreadCrew {
 public:
  // Throws RunError when not all of the threads can be started.
  ThreadCrew(Work work, int threads);
  // Forgets tasks that nobody has begun and waits for those under way.
  ~ThreadCrew();
  ThreadCrew(const ThreadCrew&) = delete;
  ThreadCrew& operator=(const ThreadCrew&) = delete;

  void give(std::size_t task, std::string bytes);
  std::size_t tasks() const { return tasks_; }  // given and not yet taken
  std::optional<TaskResult> take();             // a finished task, if there is one
  void forget();                                // tasks that nobody has begun
  // Waits until a task is finished, but no longer than this.
  void wait(std::chrono::microseconds longest);

 private:
  struct Given {
    std::size_t task;
    std::string bytes;
  };

  void stop();
  void work_on();
  TaskResult do_task(const Given& given) const;

  const Work work_;
  std::size_t tasks_ = 0;  // the owner's
  std::mutex mutex_;       // guards what follows
  std::condition_variable given_changed_;
  std::condition_variable finished_changed_;
  std::deque<Given> given_;
  std::deque<TaskResult> finished_;
  bool stop_ = false;
  std::vector<std::jthread> threads_;
};

// Rests for `pause`, or until a task of the crew is finished where there is one; not at all, but for letting others
// have the core, when the pause is 0.
void rest_beside(ThreadCrew* crew, std::chrono::microseconds pause);

}  // namespace spincat
