#include "spincat/dataset/splits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "spincat/error.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

// Streams of random numbers, so that a split and a cut into folds by one seed have nothing to do with each other.
constexpr std::uint64_t kSplitsPurpose = 0x53504C49;
constexpr std::uint64_t kFoldsPurpose = 0x464F4C44;

// The objects of each category, ascending; in the order of the labels.
std::vector<std::vector<std::uint32_t>> objects_by_category(std::span<const std::uint32_t> labels) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> objects_of;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    objects_of[labels[i]].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [label, objects] : objects_of) {
    result.push_back(std::move(objects));
  }
  return result;
}

std::size_t test_count(std::size_t objects, double test_share) {
  if (objects < 2) {
    return 0;
  }
  const double wanted = std::nearbyint(static_cast<double>(objects) * test_share);
  return std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, objects - 1);
}

void sort_parts(Split& split) {
  std::sort(split.train.begin(), split.train.end());
  std::sort(split.test.begin(), split.test.end());
}

// Takes the categories by value: they are shuffled from the same state for each split.
Split random_split(std::vector<std::vector<std::uint32_t>> categories, double test_share, std::uint64_t seed) {
  Random random(seed);
  Split split;
  for (std::vector<std::uint32_t>& objects : categories) {
    random.shuffle(objects);
    const auto middle = objects.begin() + static_cast<std::ptrdiff_t>(test_count(objects.size(), test_share));
    split.test.insert(split.test.end(), objects.begin(), middle);
    split.train.insert(split.train.end(), middle, objects.end());
  }
  sort_parts(split);
  return split;
}

}  // namespace

void check_splits(int count, double test_share) {
  if (count < 1 || count > kMostSplits) {
    throw InputError(fmt::format("number of splits {} is out of range (1 to {})", count, kMostSplits));
  }
  if (!(test_share > 0.0 && test_share < 1.0)) {
    throw InputError(fmt::format("test share {} is out of range (more than 0 and less than 1)", test_share));
  }
}

std::vector<Split> stratified_splits(std::span<const std::uint32_t> labels, int count, double test_share,
                                     std::uint64_t seed) {
  check_splits(count, test_share);
  const auto categories = objects_by_category(labels);
  if (std::none_of(categories.begin(), categories.end(), [](const auto& objects) { return objects.size() >= 2; })) {
    throw InputError("no category has two objects, one to train on and one to test on");
  }
  const std::uint64_t stream = derive_seed(seed, kSplitsPurpose);
  std::vector<Split> splits;
  for (int i = 0; i < count; ++i) {
    splits.push_back(random_split(categories, test_share, derive_seed(stream, static_cast<std::uint64_t>(i))));
  }
  return splits;
}

std::vector<Split> stratified_folds(std::span<const std::uint32_t> labels, int folds, std::uint64_t seed) {
  if (folds < 2 || static_cast<std::size_t>(folds) > labels.size()) {
    throw InputError(
        fmt::format("the number of folds is {}; expected 2 to {}, the number of objects", folds, labels.size()));
  }
  // Dealt like cards, category after category without going back to the first fold, so that not only the parts of
  // each category but also the folds differ by one object at most.
  Random random(derive_seed(seed, kFoldsPurpose));
  std::vector<std::size_t> fold_of(labels.size());
  std::size_t dealt = 0;
  for (std::vector<std::uint32_t>& objects : objects_by_category(labels)) {
    random.shuffle(objects);
    for (const std::uint32_t object : objects) {
      fold_of[object] = dealt++ % static_cast<std::size_t>(folds);
    }
  }
  std::vector<Split> splits(static_cast<std::size_t>(folds));
  for (std::uint32_t object = 0; object < fold_of.size(); ++object) {
    for (std::size_t fold = 0; fold < splits.size(); ++fold) {
      (fold == fold_of[object] ? splits[fold].test : splits[fold].train).push_back(object);
    }
  }
  return splits;
}

}  // namespace spincat
