// What a setting does: the evaluation repeated with one or two settings varied.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/settings/setting_table.h"

#pragma GCC visibility push(default)
namespace spincat {

// A setting (setting_table.h) and the values it is to take, as text.
struct Variation {
  std::string setting;
  std::vector<std::string> values;
};

// The evaluation with one value of each varied setting.
struct SweepPoint {
  std::vector<std::string> values;  // one for each variation
  Rate mean_class_rate;
  Rate overall_rate;
  StageSeconds seconds;  // added up over threads; of describing even where the features came from the point before
};

struct Sweep {
  std::string dataset;
  std::size_t objects = 0;
  std::string list_checksum;
  Settings settings;  // of the first point
  std::vector<Variation> variations;
  std::vector<SweepPoint> points;  // every combination, the last variation's values changing fastest
};

// Evaluates every combination of the values, each as if it had been chosen besides what `settings` has chosen. What
// does not change is not done again: combinations that differ in the judges' settings alone share their features.
//
// With a `journal` the sweep can be interrupted and goes on where it stopped: each point is added to that file as it is
// done. The journal knows the data set's list, settings, variations and options, and is refused (InputError, saying
// what differs) when it is of another sweep. It stays when the sweep is done, so that asking again takes no time. The
// rates are the same with and without it, interrupted or not.
//
// Throws InputError when a setting or value is not possible, before any work, and as evaluate does.
Sweep sweep(const Dataset& dataset, const SettingChoices& settings, const std::vector<Variation>& variations,
            const EvaluateOptions& options, const Execution& execution = {}, const std::filesystem::path& journal = {});

}  // namespace spincat
#pragma GCC visibility pop
