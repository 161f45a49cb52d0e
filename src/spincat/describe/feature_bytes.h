// The numbers of a feature vector where they are.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
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
  bool are_finite() const {
    for (std::size_t i = 0; i < length(); ++i) {
      float value = 0.0F;
      std::memcpy(&value, bytes.data() + i * sizeof(float), sizeof(float));
      if (!std::isfinite(value)) {
        return false;
      }
    }
    return true;
  }
};

}  // namespace spincat
