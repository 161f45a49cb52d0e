// The two halves of an evaluation, and what other ranks keep between them.
#pragma once

#include "spincat/evaluate/evaluation_data.h"
#include "spincat/train/broadcast_rows.h"

namespace spincat {

// As in evaluation_data.h. `broadcast` tells which rows of the table the other ranks of the farm have, until the next
// data set is described.
EvaluationData describe_for_evaluation(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                                       const Execution& execution, BroadcastRows& broadcast);
EvaluationData describe_across(const Dataset& train, const Dataset& test, const Settings& settings,
                               const EvaluateOptions& options, const Execution& execution, BroadcastRows& broadcast);
Evaluation judge_evaluation(const EvaluationData& data, const Settings& settings, const EvaluateOptions& options,
                            const Execution& execution, const BroadcastRows& broadcast);

}  // namespace spincat
