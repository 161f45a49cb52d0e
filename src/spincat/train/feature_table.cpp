#include "spincat/train/feature_table.h"

#include <cstddef>
#include <numeric>

namespace spincat {

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
  labels.insert(labels.end(), background_rows, static_cast<std::uint32_t>(categories.size()));
  return labels;
}

std::vector<std::uint32_t> FeatureTable::rows_of_background() const {
  std::vector<std::uint32_t> rows(background_rows);
  std::iota(rows.begin(), rows.end(), static_cast<std::uint32_t>(features.rows()) - background_rows);
  return rows;
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

}  // namespace spincat
