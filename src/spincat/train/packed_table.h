// Feature tables as bytes, for messages between ranks. Private to the library, not installed.
#pragma once

#include <tuple>

#include "spincat/dataset/dataset.h"
#include "spincat/describe/packed_matrix.h"
#include "spincat/parallel/packing.h"
#include "spincat/train/feature_table.h"

namespace spincat {

// Other ranks need to know nothing of objects but their categories.
void fields(auto& archive, MessageOf<DatasetObject> auto& object) {
  auto& [file, category, split] = object;  // does not compile when a member is forgotten
  static_cast<void>(std::tie(file, split));
  archive(category);
}

// What judges are trained by, but for the features, which other ranks may have.
void fields(auto& archive, MessageOf<FeatureTable> auto& table) {
  auto& [objects, categories, skipped, features, background_rows, other_rows, basis, blocks, local_size, words, seed,
         rows_per_object, tested_rows, encoding, kinds, seconds] =
      table;  // does not compile when a member is forgotten
  static_cast<void>(std::tie(skipped, features, basis, encoding, kinds, seconds));
  archive(objects, categories, background_rows, other_rows, blocks, local_size, words, seed, rows_per_object,
          tested_rows);
}

}  // namespace spincat
