// Numbers as raw bytes, for binary files that stand in a test.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace spincat::test {

template <typename T>
std::string little(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (std::endian::native == std::endian::big) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

template <typename T>
std::string big(T value) {
  std::string bytes = little(value);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

// The bytes of several numbers of one type.
template <typename T, typename... Rest>
std::string little_row(Rest... values) {
  return (little(static_cast<T>(values)) + ...);
}

}  // namespace spincat::test
