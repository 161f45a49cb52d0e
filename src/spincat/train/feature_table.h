// The feature vectors of a whole data set.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe.h"
#include "spincat/describe/kinds.h"
#include "spincat/judge/gram.h"

namespace spincat {

// Objects that could be read, and their features: row i * rows_per_object is object i itself, the rows after it are its
// training copies; or all rows are views of it.
struct FeatureTable {
  std::vector<DatasetObject> objects;   // N
  std::vector<std::string> categories;  // n, all of the data set
  std::vector<SkippedObject> skipped;   // the data set's, and those that could not be read, sorted by file
  FeatureMatrix features;               // N rows_per_object x D, and below them those of the background
  std::uint32_t background_rows = 0;    // objects of no category, which tell the others from strangers
  std::uint32_t other_rows = 0;         // of these, the first ones: the user's own
  FeatureMatrix basis;                  // D x F: columns are coordinates along these directions of F features; without
                                        // rows: they are the features
  std::vector<std::uint32_t> blocks;    // of columns that belong together; adds up to D
  std::uint32_t local_size = 0;         // > 0: columns are local features of so many numbers, to be counted by words
  std::uint32_t words = 0;              // of the codebook that is learned for them
  std::uint64_t seed = 1;               // of that learning
  std::uint32_t rows_per_object = 1;
  std::uint32_t tested_rows = 1;  // of these, the first ones: what may be tested, the object itself or its views
  std::string encoding;
  KindCounts kinds;      // of the objects
  StageSeconds seconds;  // added up over threads

  std::vector<std::uint32_t> object_labels() const;  // N
  std::vector<std::uint32_t> object_counts() const;  // n: objects of each category, copies not counted
  std::vector<std::uint32_t> row_labels() const;     // one for each row; of the background n
  std::vector<std::uint32_t> rows_of_background() const;
  // All rows of the given objects: what judges are trained on. A copy never leaves its object.
  std::vector<std::uint32_t> rows_of(std::span<const std::uint32_t> objects) const;
  // Of the object itself, or of its view number `view`.
  std::span<const float> features_of(std::uint32_t object, std::uint32_t view = 0) const;
};

}  // namespace spincat
