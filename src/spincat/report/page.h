// Results as pages for people: one HTML file each that needs nothing else and no network.
#pragma once

#include <string>
#include <vector>

#include "spincat/evaluate/evaluate.h"
#include "spincat/evaluate/sweep.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The rates, the confusion matrix with the objects behind each cell, and all that is needed to repeat the run. The page
// holds evaluation_json (json.h) as it is, and shows its numbers. Names, whatever is in them, are shown as text.
// Deterministic.
std::string evaluation_page(const Evaluation& evaluation, const Settings& settings, const EvaluateOptions& options,
                            const std::vector<std::string>& command);

// Rate and time against the varied setting with their spread, a heat map for two; holds sweep_json (sweep_report.h).
// Deterministic.
std::string sweep_page(const Sweep& sweep, const Settings& settings, const EvaluateOptions& options,
                       const std::vector<std::string>& command);

}  // namespace spincat
