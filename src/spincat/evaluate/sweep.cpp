#include "spincat/evaluate/sweep.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "spincat/dataset/parts.h"
#include "spincat/error.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/evaluate/sweep_journal.h"
#include "spincat/settings/setting_table.h"
#include "spincat/settings/settings_json.h"
#include "spincat/version.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<std::string>;

// Every combination, the last variation's values changing fastest.
std::vector<Values> combinations(const std::vector<Variation>& variations) {
  std::vector<Values> all = {{}};
  for (const Variation& variation : variations) {
    std::vector<Values> longer;
    for (const Values& begun : all) {
      for (const std::string& value : variation.values) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

void check(const std::vector<Variation>& variations) {
  constexpr std::size_t kMostPoints = 10'000;
  std::set<std::string> names;
  for (const Variation& variation : variations) {
    if (!names.insert(std::string(find_setting(variation.setting).name)).second) {
      throw InputError(fmt::format("setting '{}' is varied twice", variation.setting));
    }
    if (std::set(variation.values.begin(), variation.values.end()).size() != variation.values.size()) {
      throw InputError(fmt::format("setting '{}' is to take one value twice", variation.setting));
    }
  }
  const std::size_t points = combinations(variations).size();
  if (variations.empty() || points == 0 || points > kMostPoints) {
    throw InputError(fmt::format("a sweep takes 1 to {} points, not {}", kMostPoints, points));
  }
}

Settings settings_at(SettingChoices choices, const std::vector<Variation>& variations, const Values& values) {
  for (std::size_t v = 0; v < variations.size(); ++v) {
    choices = choices.with({variations[v].setting, values[v], ""});
  }
  return choices.settings();
}

// Everything that decides about the features.
std::string describing(const Settings& settings) {
  Settings s = settings;
  s.judge = JudgeSettings{};
  return settings_to_json(s).dump();
}

// What a journal must agree in for its points to be ours. Threads are not in it: they change no rate.
Json identity_of(const Dataset& dataset, const SettingChoices& settings, const std::vector<Variation>& variations,
                 const EvaluateOptions& options) {
  Json varied = Json::object();
  for (const Variation& variation : variations) {
    varied[find_setting(variation.setting).name] = variation.values;
  }
  Json chosen = Json::object();
  for (const ChosenSetting& one : settings.chosen) {
    chosen[find_setting(one.name).name] = one.text;
  }
  return {{"sweep", 1},
          {"version", kProgram},
          {"data set", list_checksum(dataset.objects, dataset.categories)},
          {"settings", settings_to_json(settings.base)},
          {"chosen", chosen},
          {"variations", varied},
          {"options",
           {{"leave_one_out", options.leave_one_out},
            {"splits", options.splits},
            {"test_share", options.test_share},
            {"split_seeds", options.split_seeds},
            {"fewest_objects", options.fewest_objects},
            {"test_as", static_cast<int>(options.test.form)},
            {"noise", options.test.used_noise()},
            {"cloud_points", options.test.used_cloud_points()},
            {"max_points", dataset.limits.max_points},
            {"max_triangles", dataset.limits.max_triangles},
            {"max_growth", dataset.limits.max_growth}}}};
}

}  // namespace

Sweep sweep(const Dataset& dataset, const SettingChoices& settings, const std::vector<Variation>& variations,
            const EvaluateOptions& options, const Execution& execution, const std::filesystem::path& journal_file) {
  check(variations);
  options.validate();
  const std::vector<Values> points = combinations(variations);
  std::vector<Settings> settings_of;
  for (const Values& values : points) {
    settings_of.push_back(settings_at(settings, variations, values));
  }
  SweepJournal journal(journal_file, identity_of(dataset, settings, variations, options));
  std::set<std::size_t> missing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (journal.find(points[i]) == nullptr) {
      missing.insert(i);
    }
  }
  while (!missing.empty()) {
    // All points that have the features of the first one that is missing.
    const std::string features = describing(settings_of[*missing.begin()]);
    std::optional<EvaluationData> data;
    BroadcastRows broadcast;
    for (auto at = missing.begin(); at != missing.end();) {
      const Settings& now = settings_of[*at];
      if (describing(now) != features) {
        ++at;
        continue;
      }
      if (!data) {
        data = describe_for_evaluation(dataset, now, options, execution, broadcast);
      }
      const Evaluation found = judge_evaluation(*data, now, options, execution, broadcast);
      journal.add({points[*at], found.mean_class_rate, found.overall_rate, found.seconds});
      at = missing.erase(at);
    }
  }
  Sweep result{dataset.name,
               dataset.objects.size(),
               list_checksum(dataset.objects, dataset.categories),
               settings_of[0],
               variations,
               {}};
  for (const Values& values : points) {
    result.points.push_back(*journal.find(values));
  }
  return result;
}

}  // namespace spincat
