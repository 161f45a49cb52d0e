// Numbers as pages carry them.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace spincat {

// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

// The numbers' bytes, little-endian as every machine that spincat runs on has them.
template <class T>
std::string base64_of(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) {
    std::memcpy(bytes.data(), values.data(), bytes.size());
  }
  return base64(bytes);
}

// -1 to 1 as a whole number up to 32767.
std::int16_t short_number(double value);

}  // namespace spincat
