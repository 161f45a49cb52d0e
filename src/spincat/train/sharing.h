// Whether other ranks are worth giving a feature table.
#pragma once

#include <cstddef>

#include "spincat/parallel/task_farm.h"

namespace spincat {

// What is to be taught on a table.
struct TeachingPlan {
  std::size_t lessons = 1;
};

// So many trainings, each with those of the folds of its calibration or without.
TeachingPlan plan_of(std::size_t trainings, bool calibrated);

struct TableSize {
  std::size_t objects = 0;
  std::size_t rows = 0;
  std::size_t length = 0;  // of a row
  std::size_t categories = 0;
};

// Whether the other ranks save more time in teaching than sending them the table takes.
bool pays_to_share(const TableSize& table, const TeachingPlan& plan, const TaskFarm& farm);

}  // namespace spincat
