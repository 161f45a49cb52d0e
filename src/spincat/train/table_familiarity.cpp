#include "spincat/train/table_familiarity.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace spincat {

Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects) {
  if (table.local_size > 0) {
    return {};  // local features are compared by the words of a codebook alone
  }
  const Eigen::Index length = table.features.cols() / table.parts;
  constexpr std::uint32_t kMostViews = 4;  // of an object: more cost each vote time and tell hardly more
  const std::uint32_t views = std::min(table.tested_rows, kMostViews);
  FeatureMatrix features(static_cast<Eigen::Index>(objects.size() * views), length);
  std::vector<std::uint32_t> labels;
  for (const std::uint32_t object : objects) {
    for (std::uint32_t view = 0; view < views; ++view) {
      features.row(static_cast<Eigen::Index>(labels.size())) =
          table.features.row(static_cast<Eigen::Index>(object) * table.rows_per_object + view).head(length);
      labels.push_back(table.objects[object].category);
    }
  }
  return make_familiarity(std::move(features), std::move(labels), static_cast<std::uint32_t>(table.categories.size()),
                          views);
}

}  // namespace spincat
