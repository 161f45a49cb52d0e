// Measuring: how often the judges are right on objects that they were not taught on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/pipeline/describe.h"
#include "spincat/pipeline/progress.h"
#include "spincat/pipeline/settings.h"

namespace spincat {

struct EvaluateOptions {
  int splits = 20;             // repeated stratified splits, 1 to 10,000
  double test_fraction = 0.2;  // of each category's objects
  bool strict = false;         // an object that cannot be read ends the evaluation instead of being left out
  int threads = 1;             // 1 or more; never changes the result
};

// Mean and sample standard deviation over the splits.
struct Rate {
  double mean = 0.0;
  double deviation = 0.0;
};

struct Evaluation {
  std::string dataset;
  std::vector<std::string> categories;       // n
  std::vector<std::uint32_t> object_counts;  // n: objects of each category
  std::vector<SkippedObject> skipped;
  int splits = 0;
  Rate mean_class_rate;  // the mean of the confusion matrix's diagonal, each row as shares (the paper's figure)
  Rate overall_rate;     // right votes over all votes
  // n x n counts added up over the splits: row = the truth, column = what the object was named.
  std::vector<std::vector<std::uint32_t>> confusion;
  StageSeconds seconds;       // added up over threads; judge: teaching and voting
  double wall_seconds = 0.0;  // of everything
};

// Describes every object once, then for each stratified split teaches the judges on the training objects and their
// copies and lets them vote on the test objects. The splits and the result are the same for the same data set, settings
// and options, whatever the number of threads. A category with a single object is never tested.
// Throws InputError when options or settings are out of range, or fewer than two categories can be read.
Evaluation evaluate(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                    const Progress& progress = {});

}  // namespace spincat
