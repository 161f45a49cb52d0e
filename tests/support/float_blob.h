// Numbers as a model file keeps them: a blob of 32-bit floats.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace spincat::test {

inline nlohmann::json float_blob(const std::vector<float>& values) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  return nlohmann::json::binary({bytes, bytes + values.size() * sizeof(float)});
}

}  // namespace spincat::test
