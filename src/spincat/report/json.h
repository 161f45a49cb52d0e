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

// What the command spin wrote.
struct SpinResult {
  std::string file;
  std::size_t images = 0;  // fewer than spin points on a contact sheet
  std::size_t spin_points = 0;
  std::size_t surface_points = 0;
  std::size_t left_out = 0;  // points of the object's file
  SpinImageShape shape;
  double bin_size = 0.0;  // in the file's unit
};

// {"file", "images", "spin_points", "surface_points", "left_out", "channels", "rows", "columns", "bin_size"}
std::string spin_json(const SpinResult& result);

// What describe wrote.
std::string features_json(const std::string& file, std::size_t objects, std::size_t features, const Settings& settings,
                          const std::vector<SkippedObject>& left_out);

}  // namespace spincat
