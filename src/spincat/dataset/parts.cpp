#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include "spincat/dataset/dataset.h"

namespace spincat {

Dataset training_part(const Dataset& dataset) {
  const auto to_learn_from = [](const DatasetObject& object) { return object.split.empty() || object.split == "train"; };
  if (!std::ranges::any_of(dataset.objects, [](const auto& object) { return object.split == "train"; })) {
    return dataset;
  }
  constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(dataset.categories.size(), kGone);
  for (const DatasetObject& object : dataset.objects) {
    if (to_learn_from(object)) {
      place[object.category] = 0;
    }
  }
  Dataset part{dataset.name, {}, {}, dataset.skipped};
  for (std::size_t c = 0; c < place.size(); ++c) {
    if (place[c] != kGone) {
      place[c] = static_cast<std::uint32_t>(part.categories.size());
      part.categories.push_back(dataset.categories[c]);
    }
  }
  for (const DatasetObject& object : dataset.objects) {
    if (to_learn_from(object)) {
      part.objects.push_back({object.file, place[object.category], object.split});
    }
  }
  return part;
}

}  // namespace spincat
