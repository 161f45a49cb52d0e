// Private to this folder, not installed: the wording that its error messages share.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace spincat {

// Text from a file, fit for a one-line message: between quotes, bytes that would break the line escaped, and cut short.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7F ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return result + (text.size() > kLongest ? "...'" : "'");
}

inline std::string at_line(std::size_t line, std::string_view problem) {
  return fmt::format("line {}: {}", line, problem);
}

}  // namespace spincat
