// Feature vectors and times as bytes, for other ranks. Private: not installed.
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "spincat/describe/describe.h"
#include "spincat/describe/feature_bytes.h"
#include "spincat/encode/feature_vector.h"
#include "spincat/error.h"
#include "spincat/parallel/packing.h"

namespace spincat {

// All but the numbers, which come first where they are wanted: they need not be copied.
void fields(auto& archive, MessageOf<FeatureVector> auto& features) {
  auto& [values, blocks, encoding, local_size] = features;  // does not compile when a member is forgotten
  static_cast<void>(values);
  archive(blocks, encoding, local_size);
}

void fields(auto& archive, MessageOf<StageSeconds> auto& seconds) {
  auto& [read, prepare, spin, encode, judge] = seconds;
  archive(read, prepare, spin, encode, judge);
}

inline void pack_features(Packer& packer, const FeatureVector& features) {
  packer.add(std::span<const float>(features.values));
  packer(features);
}

// A packed feature vector, but for the numbers, which stay where they are: `head` has no values.
struct PackedFeatures {
  FeatureVector head;
  FeatureBytes values;
};

inline PackedFeatures view_features(Unpacker& fields) {
  const std::string_view numbers = fields.get_text();
  if (numbers.size() % sizeof(float) != 0) {
    throw RunError("a damaged message between ranks: half a number");
  }
  return {fields.next<FeatureVector>(), FeatureBytes(numbers)};
}

}  // namespace spincat
