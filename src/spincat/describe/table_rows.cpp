#include "spincat/describe/table_rows.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "spincat/error.h"

namespace spincat {

void TableRows::put(std::size_t object, std::span<const FeatureBytes> features) {
  if (object >= is_there_.size() || features.size() != rows_each_) {
    throw RunError("an object came with another number of feature vectors");
  }
  const auto [shortest, longest] = std::ranges::minmax(features, {}, &FeatureBytes::length);
  if (longest.length() > length()) {  // then all that came before are too short
    features_.resize(static_cast<Eigen::Index>(is_there_.size() * rows_each_),
                     static_cast<Eigen::Index>(longest.length()));
    is_there_.assign(is_there_.size(), false);
  }
  if (shortest.length() < length()) {
    return;
  }
  for (std::size_t i = 0; i < rows_each_; ++i) {
    std::memcpy(features_.row(static_cast<Eigen::Index>(object * rows_each_ + i)).data(), features[i].bytes.data(),
                features[i].bytes.size());
  }
  is_there_[object] = true;
}

FeatureMatrix TableRows::take(std::span<const std::uint32_t> objects) {
  const std::size_t numbers = rows_each_ * length();  // of an object
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (objects[k] >= is_there_.size() || !is_there_[objects[k]]) {
      throw RunError("the rows of a feature table are not all there");
    }
    if (objects[k] != k) {
      std::memmove(features_.data() + k * numbers, features_.data() + objects[k] * numbers, numbers * sizeof(float));
    }
  }
  features_.conservativeResize(static_cast<Eigen::Index>(objects.size() * rows_each_), Eigen::NoChange);
  is_there_.clear();
  return std::exchange(features_, {});
}

}  // namespace spincat
