#include "spincat/train/describe_dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "spincat/describe/describe_tasks.h"
#include "spincat/describe/table_rows.h"
#include "spincat/error.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/train/worth_broadcasting.h"

namespace spincat {
namespace {

// What is remembered of each object but for its features, which go into the table's rows at once.
struct Seen {
  Described described;  // its feature vectors without their values
  std::size_t shortest = 0;
};

// Concatenated images are as many as the spin points: an object with fewer points than the others (a small cloud whose
// points are not repeated) cannot be compared with them.
void leave_out_shorter(const Dataset& dataset, bool strict, std::size_t length, std::vector<Seen>& objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    auto& [described, shortest] = objects[i];
    if (described.features.empty() || shortest == length) {
      continue;
    }
    described.problem = fmt::format("gives {} features where others give {}", shortest, length);
    described.features.clear();
    if (strict) {
      throw InputError(dataset.objects[i].file.string(), described.problem);
    }
  }
}

// Throws when the objects that are left can teach nothing.
void check_categories(const FeatureTable& table, const std::string& dataset) {
  if (table.categories.size() < 2) {
    throw InputError(dataset, "two or more categories are needed to learn from");
  }
  std::vector<bool> present(table.categories.size(), false);
  for (const DatasetObject& object : table.objects) {
    present[object.category] = true;
  }
  const auto missing = std::ranges::find(present, false);
  if (missing == present.end()) {
    return;
  }
  std::string problem = fmt::format("no object of category '{}' could be read",
                                    table.categories[static_cast<std::size_t>(missing - present.begin())]);
  if (!table.skipped.empty()) {
    problem += fmt::format(" ({} could not; the first, {}: {})", table.skipped.size(),
                           table.skipped.front().file.string(), table.skipped.front().reason);
  }
  throw InputError(dataset, problem);
}

// All described objects, in the order of the data set; `described` gets their places in it.
FeatureTable collect(const Dataset& dataset, std::span<const Seen> objects, TableRows rows, const Settings& settings,
                     std::vector<std::uint32_t>& described) {
  FeatureTable table;
  table.categories = dataset.categories;
  table.skipped = dataset.skipped;
  table.words = static_cast<std::uint32_t>(settings.words);
  table.seed = settings.seed;
  table.rows_per_object = static_cast<std::uint32_t>(settings.training_rows());
  table.tested_rows = static_cast<std::uint32_t>(settings.tested_rows());
  table.parts = static_cast<std::uint32_t>(settings.parts());
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const Described& one = objects[i].described;
    table.seconds += one.seconds;
    if (one.features.empty()) {
      table.skipped.push_back({dataset.objects[i].file, one.problem});
    } else {
      table.objects.push_back(dataset.objects[i]);
      described.push_back(i);
      table.kinds.add(one.kind);
      table.encoding = one.features[0].encoding;
      table.local_size = one.features[0].local_size;
      table.blocks = one.features[0].blocks;
    }
  }
  table.features = rows.take(described);
  std::ranges::stable_sort(table.skipped, {}, &SkippedObject::file);
  return table;
}

}  // namespace

FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, const Execution& execution) {
  BroadcastRows broadcast;
  return describe_dataset(dataset, settings, execution, 0, broadcast);
}

FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, const Execution& execution,
                              std::size_t trainings, BroadcastRows& broadcast) {
  settings.validate();
  settings.validate_for_judges();
  const FarmExecution run(execution);
  const bool strict = run.strict;
  if (strict && !dataset.skipped.empty()) {
    throw InputError(dataset.skipped.front().file.string(), dataset.skipped.front().reason);
  }
  const auto rows_each = static_cast<std::size_t>(settings.training_rows());
  std::vector<Seen> objects(dataset.objects.size());
  TableRows rows(objects.size(), rows_each);
  bool all_ranks_keep = false;
  DescribeJob job{objects.size(),
                  [&](std::size_t i) -> const std::filesystem::path& { return dataset.objects[i].file; },
                  settings,
                  settings.training_rows(),
                  run.split,
                  dataset.limits,
                  {}};
  job.keeps_rows = [&](std::size_t length) {
    all_ranks_keep = worth_broadcasting({objects.size(), objects.size() * rows_each, length, dataset.categories.size()},
                                        trainings, *run.farm);
    return all_ranks_keep;
  };
  const auto keep = [&](std::size_t i, const Described& one, std::span<const FeatureBytes> values) {
    if (one.lacks_memory) {  // a model of fewer objects, and nobody would know why it is worse
      throw RunError(dataset.objects[i].file.string(), one.problem);
    }
    if (strict && values.empty()) {
      throw InputError(dataset.objects[i].file.string(), one.problem);
    }
    if (!values.empty()) {
      rows.put(i, values);
      objects[i].shortest = std::ranges::min(values, {}, &FeatureBytes::length).length();
    }
    objects[i].described = one;
  };
  describe_files(*run.farm, job, keep, run.ticking("describing objects", objects.size()));
  leave_out_shorter(dataset, strict, rows.length(), objects);
  std::vector<std::uint32_t> described;
  FeatureTable table = collect(dataset, objects, std::move(rows), settings, described);
  broadcast = all_ranks_keep ? BroadcastRows{next_broadcast_id(), std::move(described)} : BroadcastRows{};
  check_categories(table, dataset.name);
  return table;
}

}  // namespace spincat
