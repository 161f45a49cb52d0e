// The one place that makes a farm where an execution names none.
#pragma once

#include <optional>

#include "spincat/execution.h"
#include "spincat/parallel/task_farm.h"

namespace spincat {

// An execution that has a farm: the one it was given, or one of its own with so many threads. Functions that are handed
// this one on do all their work on the same farm.
class FarmExecution : public Execution {
 public:
  explicit FarmExecution(const Execution& execution) : Execution(execution) {
    if (farm == nullptr) {
      farm = &own_.emplace(threads).farm();
    }
  }
  FarmExecution(const FarmExecution&) = delete;
  FarmExecution& operator=(const FarmExecution&) = delete;

  // Tells how many of the tasks of one stage are done. Refers to this object.
  TaskFarm::Tick ticking(std::string_view stage, std::size_t tasks) const {
    return [this, stage, tasks](std::size_t done) {
      if (progress) {
        progress(stage, done, tasks);
      }
    };
  }

 private:
  std::optional<LocalFarm> own_;
};

}  // namespace spincat
