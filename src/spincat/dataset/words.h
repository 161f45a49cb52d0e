// The wording that its error messages share.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace spincat {

// Text from a file, fit for a one-line message: bytes that would break the line escaped, and cut short.
inline std::string shown(std::string_view text, std::size_t longest = 400) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const std::string next = byte < 0x20 || byte == 0x7F ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    if (result.size() + next.size() > longest) {
      return result + "...";
    }
    result += next;
  }
  return result;
}

inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  return "'" + shown(text, kLongest) + "'";
}

inline std::string at_line(std::size_t line, std::string_view problem) {
  return fmt::format("line {}: {}", line, problem);
}

}  // namespace spincat
