// Learning: from a data set to a model.
#pragma once

#include <vector>

#include "spincat/classify/model.h"
#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe.h"
#include "spincat/describe/division.h"
#include "spincat/describe/progress.h"
#include "spincat/settings/settings.h"

namespace spincat {

class TaskFarm;

struct TrainOptions {
  bool strict = false;       // an object that cannot be read ends the training instead of being left out
  int threads = 1;           // 1 or more; never changes the result
  TaskFarm* farm = nullptr;  // does the work on its threads and ranks instead; never changes the result either
  Division division = Division::sums;
};

struct TrainResult {
  Model model;
  std::vector<SkippedObject> skipped;
  StageSeconds seconds;  // added up over threads; judge: training and calibration
};

// Trains the judges on every object of the data set. Deterministic.
// Throws InputError when settings are out of range or fewer than two categories have an object that can be read.
TrainResult train(const Dataset& dataset, const Settings& settings, const TrainOptions& options,
                  const Progress& progress = {});

}  // namespace spincat
