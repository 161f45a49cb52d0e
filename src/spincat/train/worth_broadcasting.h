// Whether other ranks are worth giving a feature table.
#pragma once

#include <cstddef>

#include "spincat/parallel/task_farm.h"

namespace spincat {

// How many trainings there are in all: each with those of the folds of its calibration, or without.
std::size_t count_trainings(std::size_t trainings, bool calibrated);

struct TableSize {
  std::size_t objects = 0;
  std::size_t rows = 0;
  std::size_t length = 0;  // of a row
  std::size_t categories = 0;
};

// Whether the other ranks save more time in so many trainings than sending them the table takes.
bool worth_broadcasting(const TableSize& table, std::size_t trainings, const TaskFarm& farm);

}  // namespace spincat
