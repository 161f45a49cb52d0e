// Results as JSON for programs, besides those of report.h; the keys are a promise (docs/reference/json.md).
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

// One line each, as those of report.h.

// {"file", "error"}
std::string error_json(const std::string& file, const std::string& error);

// {"file", "kind": "mesh" or "point cloud", "points", "triangles", "size", "area", "resolution", "defects": {name: n}}
std::string object_json(const std::string& file, const ObjectFacts& facts);

// {"file", "spin_points", "surface_points", "channels", "rows", "columns", "bin_size": in the file's unit}
std::string spin_json(const std::string& file, std::size_t spin_points, const SpinImageParams& params,
                      const PreparedObject& object);

// What describe wrote.
std::string features_json(const std::string& file, std::size_t objects, std::size_t features, const Settings& settings,
                          const std::vector<SkippedObject>& left_out);

}  // namespace spincat
