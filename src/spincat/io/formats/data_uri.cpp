#include "spincat/io/formats/data_uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>

#include "spincat/error.h"

namespace spincat::io {
namespace {

bool same_letters(std::string_view text, std::string_view lower) {
  return std::ranges::equal(text, lower, [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
  });
}

// The value of a digit of base64; that of web addresses has two of its own. -1 where it is none.
int base64_digit(char c) {
  static constexpr std::array<signed char, 256> kValues = [] {
    std::array<signed char, 256> values{};
    values.fill(-1);
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
      values[static_cast<unsigned char>(kDigits[i])] = static_cast<signed char>(i);
    }
    values['-'] = 62;
    values['_'] = 63;
    return values;
  }();
  return kValues[static_cast<unsigned char>(c)];
}

std::string decode_base64(std::string_view text) {
  while (text.ends_with('=')) {
    text.remove_suffix(1);
  }
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  unsigned bits = 0;
  int known = 0;
  for (const char c : text) {
    if (c == '\n' || c == '\r' || c == ' ' || c == '\t') {
      continue;
    }
    const int digit = base64_digit(c);
    if (digit < 0) {
      throw InputError("holds no valid base64");
    }
    bits = bits << 6 | static_cast<unsigned>(digit);
    known += 6;
    if (known >= 8) {
      known -= 8;
      bytes += static_cast<char>(bits >> known & 0xFFU);
    }
  }
  return bytes;
}

constexpr std::string_view kData = "data:";

}  // namespace

bool is_data_uri(std::string_view uri) {
  return same_letters(uri.substr(0, kData.size()), kData);
}

std::string decode_data_uri(std::string_view uri) {
  constexpr std::string_view kBase64 = ";base64";
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    throw InputError("has no ',' after 'data:'");
  }
  const std::string_view type = uri.substr(0, comma);
  const std::string_view content = uri.substr(comma + 1);
  const bool is_base64 =
      type.size() >= kBase64.size() && same_letters(type.substr(type.size() - kBase64.size()), kBase64);
  if (!is_base64) {
    return decode_percent(content);
  }
  return content.find('%') == std::string_view::npos ? decode_base64(content) : decode_base64(decode_percent(content));
}

std::string decode_percent(std::string_view uri) {
  std::string text;
  while (!uri.empty()) {
    const std::string_view digits = uri.substr(1, 2);
    unsigned value = 0;
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
    const bool coded = uri[0] == '%' && digits.size() == 2 && end == digits.data() + 2;
    text += coded ? static_cast<char>(value) : uri[0];
    uri.remove_prefix(coded ? 3 : 1);
  }
  return text;
}

}  // namespace spincat::io
