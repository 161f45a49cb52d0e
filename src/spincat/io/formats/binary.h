// Numbers out of raw bytes. Private to io.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace spincat::io {

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8:
      return 1;
    case ScalarType::int16:
    case ScalarType::uint16:
      return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32:
      return 4;
    case ScalarType::int64:
    case ScalarType::uint64:
    case ScalarType::float64:
      return 8;
  }
  return 8;
}

// A T whose bytes begin at `at`, wherever that is.
template <typename T>
T load(const char* at, std::endian order = std::endian::little) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, at, sizeof(T));
  if (order != std::endian::native) {
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) {
      std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    }
  }
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

inline double load_scalar(const char* at, ScalarType type, std::endian order = std::endian::little) {
  switch (type) {
    case ScalarType::int8:
      return load<std::int8_t>(at, order);
    case ScalarType::uint8:
      return load<std::uint8_t>(at, order);
    case ScalarType::int16:
      return load<std::int16_t>(at, order);
    case ScalarType::uint16:
      return load<std::uint16_t>(at, order);
    case ScalarType::int32:
      return load<std::int32_t>(at, order);
    case ScalarType::uint32:
      return load<std::uint32_t>(at, order);
    case ScalarType::int64:
      return static_cast<double>(load<std::int64_t>(at, order));
    case ScalarType::uint64:
      return static_cast<double>(load<std::uint64_t>(at, order));
    case ScalarType::float32:
      return static_cast<double>(load<float>(at, order));
    case ScalarType::float64:
      return load<double>(at, order);
  }
  return 0;
}

}  // namespace spincat::io
