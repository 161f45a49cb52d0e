// What a farm does: many tasks of one kind, each bytes in and bytes out.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace spincat {

// Does one task. May be called by several threads at once. What it throws reaches the caller of the farm.
using Work = std::function<std::string(std::string_view task)>;

// Makes the work of a kind from what all its tasks share; may keep what later work needs. Called once a job on each
// rank but 0, by one thread.
using WorkFactory = std::function<Work(std::string_view kind, std::string_view context)>;

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
