// The two halves of an evaluation: describing objects, and judging what was described.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/evaluate/tested_objects.h"
#include "spincat/execution.h"
#include "spincat/settings/settings.h"
#include "spincat/train/broadcast_rows.h"
#include "spincat/train/feature_table.h"

namespace spincat {

// What an evaluation needs of its objects, described once. The judges' settings play no part in it, so that one of
// these serves all of them.
struct EvaluationData {
  std::string dataset;
  std::string test_dataset;
  FeatureTable table;               // to learn from, and to test unless there is `tested`
  FeatureMatrix basis;              // of the table's columns, where these are coordinates (FeatureTable::basis)
  std::optional<TestTable> tested;  // the objects of another data set, or those of `table` in another form
  bool across = false;              // `tested` is another data set
  TestTable unknown_objects;
  std::vector<LeftOutCategory> left_out;
  double wall_seconds = 0.0;
};

// Describes every object of the data set once, and again in the form it is tested in where that is another.
// `broadcast` then tells which rows of the table the other ranks of the farm have, until the next data set is
// described. Throws InputError when options or settings are out of range, or fewer than two categories can be read.
EvaluationData describe_for_evaluation(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                                       const Execution& execution, BroadcastRows& broadcast);

// The same for judges that learn from one data set and are tested on another. Categories are matched by their names;
// those missing on either side are left out. Throws as the above and common_categories (dataset/parts.h) do.
EvaluationData describe_across(const Dataset& train, const Dataset& test, const Settings& settings,
                               const EvaluateOptions& options, const Execution& execution, BroadcastRows& broadcast);

// The other half of evaluate.
Evaluation judge_evaluation(const EvaluationData& data, const Settings& settings, const EvaluateOptions& options,
                            const Execution& execution, const BroadcastRows& broadcast);

}  // namespace spincat
