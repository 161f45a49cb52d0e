// Results as JSON for programs, and as pages for people: one HTML file each that needs nothing else and no network.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/classify/model.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/evaluate/sweep.h"
#include "spincat/geometry/object.h"
#include "spincat/settings/settings.h"
#include "spincat/train/train.h"

#pragma GCC visibility push(default)
namespace spincat {

// JSON: one line each, without the line's end; the keys are a promise (docs/reference/json.md). Texts that are no UTF-8
// get U+FFFD in place of what is wrong. `command`, here and below, is the command line, word by word, where there was
// one: it is shown for whoever wants to repeat the run.

// {"file", "category", "confidence", "votes": {category: n}, "milliseconds"}, and with `every_judge` also
// "judges": [{"a", "b", "vote", "margin"}]. "kind_mismatch" says why the judges were not trained for such an object,
// where that is so. When the name is `rejected` for want of confidence, "category" is "unknown", and "best_guess" has
// the name.
std::string classification_json(const std::string& file, const Classification& classification, const Model& model,
                                bool every_judge, bool rejected = false);
// {"file", "kind": "model", "made_by", "dataset", "categories", "object_counts": {category: n}, "features", "judges",
//  "settings"}
std::string model_json(const std::string& file, const Model& model);

// As model_json, and "stage_seconds", "skipped": [{"file", "error"}]
std::string training_json(const std::string& file, const TrainResult& result);

// {"file", "kind": "mesh" or "point cloud", "points", "triangles", "size", "area", "resolution", "defects": {name: n}}
// Precondition: the object has a point.
std::string object_json(const std::string& file, const Object& object);

// The rates with their intervals, the confusion matrix, and all that is needed to repeat the run; `command` is the
// command line, word by word. Keys: docs/reference/json.md.
std::string evaluation_json(const Evaluation& evaluation, const Settings& settings, const EvaluateOptions& options,
                            const std::vector<std::string>& command);

// One object in one line; keys: docs/reference/json.md.
std::string sweep_json(const Sweep& sweep, const Settings& settings, const EvaluateOptions& options,
                       const std::vector<std::string>& command);

// A header line, then a line for each point: the varied settings by name, mean_class_rate, mean_class_rate_std,
// mean_class_rate_low, mean_class_rate_high, the same for overall_rate, and seconds by stage.
std::string sweep_csv(const Sweep& sweep);

// Pages. Names, whatever is in them, are shown as text. Deterministic.

// The rates, the confusion matrix with the objects behind each cell, and all that is needed to repeat the run. The page
// holds evaluation_json as it is, and shows its numbers.
std::string evaluation_page(const Evaluation& evaluation, const Settings& settings, const EvaluateOptions& options,
                            const std::vector<std::string>& command);

// Rate and time against the varied setting with their spread, a heat map for two; holds sweep_json.
std::string sweep_page(const Sweep& sweep, const Settings& settings, const EvaluateOptions& options,
                       const std::vector<std::string>& command);

// An object that was named.
struct NamedObject {
  std::string file;
  Object object;
  Classification classification;
};

// Each object in 3D with what its spin points say (evidence.h), its votes and every judge's margin. `model_file`: as
// the user gave it. Throws as explain does.
std::string classification_page(const std::string& model_file, const Model& model, std::span<const NamedObject> objects,
                                const std::vector<std::string>& command = {});

// The object with its surface points, their normals and its spin points, its facts, and which of its triangles are
// broken. The points are those that the first part of describe uses with these settings. Throws as describe does.
std::string object_page(const std::string& file, const Object& object, const Settings& settings,
                        const std::vector<std::string>& command = {});

}  // namespace spincat
#pragma GCC visibility pop
