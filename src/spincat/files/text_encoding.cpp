#include "spincat/files/text_encoding.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "spincat/error.h"

namespace spincat {
namespace {

enum class Order { little, big };

std::uint32_t unit_at(std::string_view bytes, std::size_t unit, Order order) {
  const auto first = static_cast<unsigned char>(bytes[2 * unit]);
  const auto second = static_cast<unsigned char>(bytes[2 * unit + 1]);
  return order == Order::little ? first | (std::uint32_t{second} << 8) : second | (std::uint32_t{first} << 8);
}

bool is_ascii_text(std::uint32_t unit) {
  return (unit >= ' ' && unit <= '~') || (unit >= '\t' && unit <= '\r');
}

// How many of the first units are ASCII, at least `share` of them. Numbers in binary form hardly ever are.
bool begins_with_ascii(std::string_view bytes, Order order, double share) {
  constexpr std::size_t kLooked = 64;
  const std::size_t units = std::min(bytes.size() / 2, kLooked);
  std::size_t ascii = 0;
  for (std::size_t i = 0; i < units; ++i) {
    ascii += is_ascii_text(unit_at(bytes, i, order)) ? 1 : 0;
  }
  return units > 0 && static_cast<double>(ascii) >= share * static_cast<double>(units);
}

std::optional<Order> order_without_mark(std::string_view bytes) {
  constexpr std::size_t kLeast = 8;  // bytes
  for (const Order order : {Order::little, Order::big}) {
    if (bytes.size() >= kLeast && begins_with_ascii(bytes, order, 1.0)) {
      return order;
    }
  }
  return std::nullopt;
}

// A mark, and an ASCII letter in four bytes.
bool is_utf32(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::size_t kLeast = 8;
  return bytes.size() >= kLeast && ((bytes.starts_with("\xFF\xFE\0\0"sv) && bytes.substr(5, 3) == "\0\0\0"sv) ||
                                    (bytes.starts_with("\0\0\xFE\xFF"sv) && bytes.substr(4, 3) == "\0\0\0"sv));
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto tail = [&](std::uint32_t shift) { text += static_cast<char>(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0U | (code >> 6));
    tail(0);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0U | (code >> 12));
    tail(6);
    tail(0);
  } else {
    text += static_cast<char>(0xF0U | (code >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

std::string decoded(std::string_view bytes, Order order) {
  const auto is_first_half = [](std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; };
  const auto is_second_half = [](std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; };
  std::string text;
  text.reserve(bytes.size() / 2 + bytes.size() / 8);
  const std::size_t units = bytes.size() / 2;
  for (std::size_t i = 0; i < units; ++i) {
    std::uint32_t code = unit_at(bytes, i, order);
    if (is_first_half(code) && i + 1 < units && is_second_half(unit_at(bytes, i + 1, order))) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit_at(bytes, ++i, order) - 0xDC00);
    } else if (is_first_half(code) || is_second_half(code)) {
      code = 0xFFFD;
    }
    append_utf8(text, code);
  }
  return text;
}

}  // namespace

std::optional<std::string> utf8_of_utf16(std::string_view bytes) {
  constexpr double kMostly = 0.5;
  for (const Order order : {Order::little, Order::big}) {
    const std::string_view mark = order == Order::little ? "\xFF\xFE" : "\xFE\xFF";
    if (bytes.starts_with(mark) && begins_with_ascii(bytes.substr(2), order, kMostly)) {
      return decoded(bytes.substr(2), order);
    }
  }
  if (is_utf32(bytes)) {
    throw InputError("is text in UTF-32; UTF-8 or UTF-16 is expected");
  }
  if (const auto order = order_without_mark(bytes)) {
    return decoded(bytes, *order);
  }
  return std::nullopt;
}

}  // namespace spincat
