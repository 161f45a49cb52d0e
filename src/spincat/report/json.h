// Results as JSON for programs; the keys are a promise (docs/reference/json.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/classify/model.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/prepare/facts.h"
#include "spincat/prepare/prepare.h"
#include "spincat/spin/params.h"
#include "spincat/train/train.h"

namespace spincat {

// One line each, without the line's end. Texts that are no UTF-8 get U+FFFD in place of what is wrong.
// {"file", "category", "confidence", "votes": {category: n}, "milliseconds"}, and with `every_judge` also
// "judges": [{"a", "b", "vote", "margin"}]. When the name is `rejected` for want of confidence, "category" is
// "unknown", and "best_guess" has the name.
std::string classification_json(const std::string& file, const Classification& classification, const Model& model,
                                bool every_judge, bool rejected = false);
// {"file", "error"}
std::string error_json(const std::string& file, const std::string& error);

// The rates with their intervals, the confusion matrix, and all that is needed to repeat the run; `command` is the
// command line, word by word. Keys: docs/reference/json.md.
std::string evaluation_json(const Evaluation& evaluation, const Settings& settings, const EvaluateOptions& options,
                            const std::vector<std::string>& command);

// {"file", "kind": "model", "made_by", "dataset", "categories", "object_counts": {category: n}, "features", "judges",
//  "settings"}
std::string model_json(const std::string& file, const Model& model);

// {"file", "kind": "mesh" or "point cloud", "points", "triangles", "size", "area", "resolution", "defects": {name: n}}
std::string object_json(const std::string& file, const ObjectFacts& facts);

// As model_json, and "stage_seconds", "skipped": [{"file", "error"}]
std::string training_json(const std::string& file, const TrainResult& result);

// {"file", "spin_points", "surface_points", "channels", "rows", "columns", "bin_size": in the file's unit}
std::string spin_json(const std::string& file, std::size_t spin_points, const SpinImageParams& params,
                      const PreparedObject& object);

// What describe wrote.
std::string features_json(const std::string& file, std::size_t objects, std::size_t features, const Settings& settings,
                          const std::vector<SkippedObject>& left_out);

}  // namespace spincat
