#include "spincat/dataset/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <unordered_set>

#include "spincat/dataset/words.h"
#include "spincat/error.h"

namespace spincat {
namespace {

// The objects that `wanted` picks, and the categories that have such objects.
Dataset part_of(const Dataset& dataset, const std::function<bool(const DatasetObject&)>& wanted) {
  constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(dataset.categories.size(), kGone);
  for (const DatasetObject& object : dataset.objects) {
    if (wanted(object)) {
      place[object.category] = 0;
    }
  }
  Dataset part{dataset.name, {}, {}, dataset.skipped, dataset.others, dataset.limits};
  for (std::size_t c = 0; c < place.size(); ++c) {
    if (place[c] != kGone) {
      place[c] = static_cast<std::uint32_t>(part.categories.size());
      part.categories.push_back(dataset.categories[c]);
    }
  }
  for (const DatasetObject& object : dataset.objects) {
    if (wanted(object)) {
      part.objects.push_back({object.file, place[object.category], object.split});
    }
  }
  return part;
}

bool has_split(const Dataset& dataset, std::string_view split) {
  return std::ranges::any_of(dataset.objects, [&](const auto& object) { return object.split == split; });
}

// The categories of `dataset` that `other` has, too; the rest is left out.
Dataset shared_part(const Dataset& dataset, const Dataset& other, std::vector<LeftOutCategory>& left_out) {
  std::vector<bool> shared;
  for (const std::string& category : dataset.categories) {
    shared.push_back(std::ranges::binary_search(other.categories, category));
    if (!shared.back()) {
      left_out.push_back({category, "is not in " + other.name});
    }
  }
  return part_of(dataset, [&](const DatasetObject& object) { return shared[object.category]; });
}

void check_disjoint(const Dataset& train, const Dataset& test) {
  std::unordered_set<std::string> files;
  const auto real = [](const DatasetObject& object) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(object.file, error);
    return (error ? object.file : path).string();
  };
  for (const DatasetObject& object : train.objects) {
    files.insert(real(object));
  }
  for (const DatasetObject& object : test.objects) {
    if (files.contains(real(object))) {
      throw InputError(object.file.string(), "is in both data sets: an object that is tested must not be learned from");
    }
  }
}

}  // namespace

Dataset training_part(const Dataset& dataset) {
  if (!has_split(dataset, "train")) {
    return dataset;
  }
  return part_of(dataset, [](const auto& object) { return object.split.empty() || object.split == "train"; });
}

Dataset testing_part(const Dataset& dataset) {
  if (!has_split(dataset, "test")) {
    throw InputError(dataset.name, "has no split of its own: no object is marked 'test'");
  }
  Dataset part = part_of(dataset, [](const auto& object) { return object.split == "test"; });
  if (part.objects.size() == dataset.objects.size()) {
    throw InputError(dataset.name, "has no split of its own: every object is marked 'test'");
  }
  return part;
}

Dataset with_enough_objects(const Dataset& dataset, int fewest, std::vector<LeftOutCategory>& left_out) {
  std::vector<int> objects(dataset.categories.size(), 0);
  for (const DatasetObject& object : dataset.objects) {
    ++objects[object.category];
  }
  for (std::size_t c = 0; c < objects.size(); ++c) {
    if (objects[c] < fewest) {
      left_out.push_back(
          {dataset.categories[c], fmt::format("has {} object{}", objects[c], objects[c] == 1 ? "" : "s")});
    }
  }
  return part_of(dataset, [&](const DatasetObject& object) { return objects[object.category] >= fewest; });
}

std::pair<Dataset, Dataset> common_categories(const Dataset& train, const Dataset& test,
                                              std::vector<LeftOutCategory>& left_out) {
  std::pair<Dataset, Dataset> both = {shared_part(train, test, left_out), shared_part(test, train, left_out)};
  if (both.first.categories.size() < 2) {
    throw InputError(test.name,
                     fmt::format("shares {} with {}: two or more categories are needed",
                                 both.first.categories.empty() ? "no category"
                                                               : "only category " + in_quotes(both.first.categories[0]),
                                 train.name));
  }
  check_disjoint(both.first, both.second);
  return both;
}

}  // namespace spincat
