// The rows of a feature table, while its objects come in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/describe/feature_bytes.h"
#include "spincat/judge/gram.h"

namespace spincat {

// Takes the feature vectors of objects, in any order, straight into the matrix that becomes the table's: there is never
// a second copy of them. Every rank that needs the table fills one.
class TableRows {
 public:
  // For so many objects, each with `rows_each` feature vectors; memory is used for those that come.
  TableRows(std::size_t objects, std::size_t rows_each) : rows_each_(rows_each), is_there_(objects, false) {}

  // The length of the longest feature vector so far; objects with a shorter one are not kept.
  std::size_t length() const { return static_cast<std::size_t>(features_.cols()); }

  // Throws RunError for an object or a number of vectors that cannot be.
  void put(std::size_t object, std::span<const FeatureBytes> features);

  // The rows of the given objects, one object after the other. This is empty afterwards. Precondition: ascending.
  // Throws RunError when one of them has not come.
  FeatureMatrix take(std::span<const std::uint32_t> objects);

 private:
  std::size_t rows_each_;
  std::vector<bool> is_there_;  // of each object
  FeatureMatrix features_;
};

}  // namespace spincat
