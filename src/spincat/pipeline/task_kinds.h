// What other ranks can do for rank 0.
#pragma once

#include "spincat/parallel/task.h"

namespace spincat {

// The names of the kinds of work, as ranks tell each other.
inline constexpr const char* kImagesTasks = "spin images of one object";
inline constexpr const char* kSumsTasks = "sums of one object";
inline constexpr const char* kClassifyTasks = "names of objects";
inline constexpr const char* kDescribeTasks = "feature vectors of objects";
inline constexpr const char* kTestedTasks = "feature vectors of test objects";
inline constexpr const char* kTableTasks = "a table to keep";
inline constexpr const char* kGramTasks = "inner products";
inline constexpr const char* kJudgesTasks = "judges";
inline constexpr const char* kTrialTasks = "splits";

// Makes any of them: for serve() (parallel/task_server.h).
WorkFactory pipeline_work();

}  // namespace spincat
