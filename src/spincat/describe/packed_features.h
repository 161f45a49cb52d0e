// Feature vectors and times as bytes, for other ranks. Private: not installed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "spincat/describe/describe.h"
#include "spincat/describe/feature_bytes.h"
#include "spincat/encode/feature_vector.h"
#include "spincat/error.h"
#include "spincat/parallel/packing.h"

namespace spincat {

inline void pack_features(Packer& packer, const FeatureVector& features) {
  const auto& [values, blocks, encoding, local_size] = features;  // does not compile when a member is forgotten
  packer.add(std::span<const float>(values)).add(std::span<const std::uint32_t>(blocks));
  packer.add(std::string_view(encoding)).add(local_size);
}

// A packed feature vector, but for the numbers, which stay where they are: `head` has no values.
struct PackedFeatures {
  FeatureVector head;
  FeatureBytes values;
};

inline PackedFeatures view_features(Unpacker& fields) {
  const std::string_view numbers = fields.get_text();
  if (numbers.size() % sizeof(float) != 0) {
    throw RunError("a message between ranks holds half a number");
  }
  PackedFeatures features{{}, FeatureBytes(numbers)};
  features.head.blocks = fields.get_values<std::uint32_t>();
  features.head.encoding = fields.get_text();
  features.head.local_size = fields.get<std::uint32_t>();
  return features;
}

inline void pack_seconds(Packer& packer, const StageSeconds& seconds) {
  const auto& [read, prepare, spin, encode, judge] = seconds;
  packer.add(read).add(prepare).add(spin).add(encode).add(judge);
}

inline StageSeconds unpack_seconds(Unpacker& fields) {
  StageSeconds seconds;
  seconds.read = fields.get<double>();
  seconds.prepare = fields.get<double>();
  seconds.spin = fields.get<double>();
  seconds.encode = fields.get<double>();
  seconds.judge = fields.get<double>();
  return seconds;
}

}  // namespace spincat
