// Whole numbers from JSON, which nlohmann's get() would quietly cut or wrap around. Private: not installed.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace spincat {

// Nothing when it is no whole number (not even 2.0), or is beyond T.
template <class T>
std::optional<T> whole_number(const nlohmann::json& json) {
  if (json.is_number_unsigned()) {
    const auto value = json.get<std::uint64_t>();
    return std::in_range<T>(value) ? std::optional<T>(static_cast<T>(value)) : std::nullopt;
  }
  if (json.is_number_integer()) {
    const auto value = json.get<std::int64_t>();
    return std::in_range<T>(value) ? std::optional<T>(static_cast<T>(value)) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace spincat
