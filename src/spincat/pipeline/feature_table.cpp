#include "spincat/pipeline/feature_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "spincat/error.h"
#include "spincat/pipeline/describe_tasks.h"

namespace spincat {
namespace {

// Concatenated images are as many as the spin points: an object with fewer points than the others (a small cloud whose
// points are not repeated) cannot be compared with them.
void leave_out_shorter(const Dataset& dataset, bool strict, std::vector<Described>& described) {
  std::size_t length = 0;
  for (const Described& object : described) {
    for (const FeatureVector& features : object.features) {
      length = std::max(length, features.values.size());
    }
  }
  for (std::size_t i = 0; i < described.size(); ++i) {
    const auto shorter = std::ranges::find_if(
        described[i].features, [&](const FeatureVector& features) { return features.values.size() != length; });
    if (shorter == described[i].features.end()) {
      continue;
    }
    described[i].problem = fmt::format("gives {} features where others give {}", shorter->values.size(), length);
    described[i].features.clear();
    if (strict) {
      throw InputError(dataset.objects[i].file.string(), described[i].problem);
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

// Moves all described objects into one table, in the order of the data set.
FeatureTable collect(const Dataset& dataset, std::vector<Described> described, const Settings& settings) {
  FeatureTable table;
  table.categories = dataset.categories;
  table.skipped = dataset.skipped;
  table.words = static_cast<std::uint32_t>(settings.words);
  table.seed = settings.seed;
  table.rows_per_object = static_cast<std::uint32_t>(settings.training_rows());
  table.tested_rows = static_cast<std::uint32_t>(settings.tested_rows());
  table.parts = static_cast<std::uint32_t>(settings.parts());
  Eigen::Index length = 0;
  for (std::size_t i = 0; i < described.size(); ++i) {
    table.seconds += described[i].seconds;
    if (described[i].features.empty()) {
      table.skipped.push_back({dataset.objects[i].file, described[i].problem});
    } else {
      table.objects.push_back(dataset.objects[i]);
      table.kinds.add(described[i].kind);
      table.encoding = described[i].features[0].encoding;
      table.local_size = described[i].features[0].local_size;
      table.blocks = described[i].features[0].blocks;
      length = static_cast<Eigen::Index>(described[i].features[0].values.size());
    }
  }
  table.features.resize(static_cast<Eigen::Index>(table.objects.size() * table.rows_per_object), length);
  Eigen::Index row = 0;
  for (Described& object : described) {
    for (const FeatureVector& features : object.features) {
      std::ranges::copy(features.values, table.features.row(row++).data());
    }
    object.features = {};  // frees as it goes: both copies together would be twice the memory
  }
  std::ranges::stable_sort(table.skipped, {}, &SkippedObject::file);
  return table;
}

}  // namespace

std::vector<std::uint32_t> FeatureTable::object_labels() const {
  std::vector<std::uint32_t> labels;
  labels.reserve(objects.size());
  for (const DatasetObject& object : objects) {
    labels.push_back(object.category);
  }
  return labels;
}

std::vector<std::uint32_t> FeatureTable::object_counts() const {
  std::vector<std::uint32_t> counts(categories.size(), 0);
  for (const DatasetObject& object : objects) {
    ++counts[object.category];
  }
  return counts;
}

std::vector<std::uint32_t> FeatureTable::row_labels() const {
  std::vector<std::uint32_t> labels;
  labels.reserve(objects.size() * rows_per_object);
  for (const DatasetObject& object : objects) {
    labels.insert(labels.end(), rows_per_object, object.category);
  }
  return labels;
}

std::vector<std::uint32_t> FeatureTable::rows_of(std::span<const std::uint32_t> some_objects) const {
  std::vector<std::uint32_t> rows;
  rows.reserve(some_objects.size() * rows_per_object);
  for (const std::uint32_t object : some_objects) {
    for (std::uint32_t copy = 0; copy < rows_per_object; ++copy) {
      rows.push_back(object * rows_per_object + copy);
    }
  }
  return rows;
}

std::span<const float> FeatureTable::features_of(std::uint32_t object, std::uint32_t view) const {
  const auto row = static_cast<Eigen::Index>(object) * rows_per_object + view;
  return {features.row(row).data(), static_cast<std::size_t>(features.cols())};
}

FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, bool strict, TaskFarm& farm,
                              Division division, const Progress& progress) {
  settings.validate();
  if (strict && !dataset.skipped.empty()) {
    throw InputError(dataset.skipped.front().file.string(), dataset.skipped.front().reason);
  }
  std::vector<Described> described(dataset.objects.size());
  const DescribeJob job{dataset.objects.size(),
                        [&](std::size_t i) -> const std::filesystem::path& { return dataset.objects[i].file; },
                        settings, settings.training_rows(), division};
  const auto keep = [&](std::size_t i, Described one) {
    if (strict && one.features.empty()) {
      throw InputError(dataset.objects[i].file.string(), one.problem);
    }
    described[i] = std::move(one);
  };
  describe_files(farm, job, keep, [&](std::size_t done) {
    if (progress) {
      progress("describing objects", done, dataset.objects.size());
    }
  });
  leave_out_shorter(dataset, strict, described);
  FeatureTable table = collect(dataset, std::move(described), settings);
  check_categories(table, dataset.name);
  return table;
}

FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, bool strict, int threads,
                              const Progress& progress) {
  OwnFarm own(threads);
  return describe_dataset(dataset, settings, strict, own.farm(), Division::sums, progress);
}

}  // namespace spincat
