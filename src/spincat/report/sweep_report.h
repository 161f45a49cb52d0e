// A sweep as a table for people, and as JSON and CSV for programs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spincat/evaluate/sweep.h"

namespace spincat {

// A line for each point: the values, the rates with their spread, the time by stage (where that is wider than `width`
// columns, of all stages together).
std::string sweep_text(const Sweep& sweep, std::size_t width);

// One object in one line; keys: docs/reference/json.md.
std::string sweep_json(const Sweep& sweep, const Settings& settings, const EvaluateOptions& options,
                       const std::vector<std::string>& command);

// A header line, then a line for each point: the varied settings by name, mean_class_rate, mean_class_rate_std,
// mean_class_rate_low, mean_class_rate_high, the same for overall_rate, and seconds by stage.
std::string sweep_csv(const Sweep& sweep);

}  // namespace spincat
