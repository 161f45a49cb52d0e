// Learning: from a data set to a model.
#pragma once

#include <vector>

#include "spincat/classify/model.h"
#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe.h"
#include "spincat/execution.h"
#include "spincat/settings/settings.h"

#pragma GCC visibility push(default)
namespace spincat {

struct TrainResult {
  Model model;
  std::vector<SkippedObject> skipped;
  StageSeconds seconds;  // added up over threads; judge: training and calibration
};

// Trains the judges on every object of the data set. Deterministic, whatever the execution.
// Throws InputError when settings are out of range or fewer than two categories have an object that can be read.
TrainResult train(const Dataset& dataset, const Settings& settings, const Execution& execution = {});

}  // namespace spincat
#pragma GCC visibility pop
