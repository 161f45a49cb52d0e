// The numbers of a feature vector where they are.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace spincat {

// Floats as bytes, as packed ones lie anywhere: only to be copied.
struct FeatureBytes {
  std::string_view bytes;

  explicit FeatureBytes(std::string_view packed) : bytes(packed) {}
  explicit FeatureBytes(std::span<const float> values)
      : bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes()) {}
  std::size_t length() const { return bytes.size() / sizeof(float); }
};

}  // namespace spincat
