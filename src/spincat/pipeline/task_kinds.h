// What other ranks can do for rank 0.
#pragma once

#include "spincat/parallel/task.h"

namespace spincat {

// The names of the kinds of work, as ranks tell each other.
inline constexpr const char* kImagesTasks = "spin images of one object";
inline constexpr const char* kSumsTasks = "sums of one object";
inline constexpr const char* kClassifyTasks = "names of objects";
inline constexpr const char* kDescribeTasks = "feature vectors of objects";

// Makes any of them: for serve() (parallel/task_server.h).
WorkFactory pipeline_work();

}  // namespace spincat
