#include "spincat/io/formats/npy_array.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "spincat/error.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

constexpr std::string_view kBlanks = " \t\n";

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// What follows the key in the text of a Python dictionary.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = quote + std::string(key) + quote;
    const std::size_t at = dictionary.find(quoted);
    if (at != std::string_view::npos) {
      const std::string_view rest = without_blanks(dictionary.substr(at + quoted.size()));
      if (rest.starts_with(':')) {
        return without_blanks(rest.substr(1));
      }
    }
  }
  throw InputError(fmt::format("is no NumPy array: its header has no '{}'", key));
}

// A number of 16 bits, as IEEE 754 has it.
double from_half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 0x1F;
  const int fraction = bits & 0x3FF;
  double value = std::ldexp(fraction, -24);
  if (exponent == 0x1F) {
    value = fraction == 0 ? HUGE_VAL : NAN;
  } else if (exponent > 0) {
    value = std::ldexp(1024 + fraction, exponent - 25);
  }
  return (bits & 0x8000) != 0 ? -value : value;
}

std::optional<ScalarType> number_type(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, ScalarType>, 10> kTypes = {{{"f4", ScalarType::float32},
                                                                                      {"f8", ScalarType::float64},
                                                                                      {"i1", ScalarType::int8},
                                                                                      {"i2", ScalarType::int16},
                                                                                      {"i4", ScalarType::int32},
                                                                                      {"i8", ScalarType::int64},
                                                                                      {"u1", ScalarType::uint8},
                                                                                      {"u2", ScalarType::uint16},
                                                                                      {"u4", ScalarType::uint32},
                                                                                      {"u8", ScalarType::uint64}}};
  for (const auto& [known, type] : kTypes) {
    if (known == name) {
      return type;
    }
  }
  return std::nullopt;
}

}  // namespace

NpyArray::NpyArray(std::string_view bytes, std::uint64_t size) {
  constexpr std::size_t kShort = 10, kLong = 12;  // before the text
  if (!is_begin(bytes)) {
    throw InputError("is no NumPy array: it does not begin with its mark");
  }
  const bool is_short = bytes.size() >= kShort && bytes[6] == 1;
  const std::size_t begin = is_short ? kShort : kLong;
  if (bytes.size() < begin) {
    throw InputError("is cut off within its header");
  }
  if (bytes[6] < 1 || bytes[6] > 3) {
    throw InputError(fmt::format("is a NumPy array of version {}; spincat reads 1 to 3",
                                 static_cast<unsigned>(static_cast<unsigned char>(bytes[6]))));
  }
  const std::size_t length = is_short ? load<std::uint16_t>(bytes.data() + 8) : load<std::uint32_t>(bytes.data() + 8);
  if (length > bytes.size() - begin) {
    throw InputError("is cut off within its header");
  }
  read_header(bytes.substr(begin, length));
  numbers_ = bytes.substr(begin + length);
  std::uint64_t count = 1;
  const std::uint64_t there = (size - std::min<std::uint64_t>(size, begin + length)) / size_;
  for (const std::uint64_t side : shape_) {
    if (side != 0 && count > (std::uint64_t{1} << 60) / side) {
      throw InputError(fmt::format("is cut off: {} numbers do not make {}", there, shape_text()));
    }
    count *= side;
  }
  if (there < count) {
    throw InputError(fmt::format("is cut off: {} of {} numbers", there, count));
  }
}

void NpyArray::read_header(std::string_view text) {
  read_type(value_of(text, "descr"));
  const std::string_view order = value_of(text, "fortran_order");
  columns_first_ = order.starts_with("True");
  if (!columns_first_ && !order.starts_with("False")) {
    throw InputError("is no NumPy array: its 'fortran_order' is neither True nor False");
  }
  read_shape(value_of(text, "shape"));
}

void NpyArray::read_type(std::string_view value) {
  if (value.starts_with('[')) {
    throw InputError("holds records with names; expected one array of numbers, a point a row");
  }
  const char quote = value.empty() ? '\0' : value[0];
  const std::string_view type = value.substr(0, value.find(quote, 1)).substr(std::min<std::size_t>(1, value.size()));
  const std::string_view name = type.substr(std::min<std::size_t>(1, type.size()));
  const std::optional<ScalarType> known = number_type(name);
  is_half_ = name == "f2";
  if ((quote != '\'' && quote != '"') || type.empty() || std::string_view("<>=|").find(type[0]) == std::string::npos ||
      (!known && !is_half_)) {
    throw InputError(
        fmt::format("holds values of the type {}; expected numbers (f2 f4 f8 i1 to i8 u1 to u8)", in_quotes(type)));
  }
  type_ = known.value_or(ScalarType::uint16);
  size_ = size_of(type_);
  order_ = type[0] == '>' ? std::endian::big : type[0] == '<' ? std::endian::little : std::endian::native;
}

void NpyArray::read_shape(std::string_view value) {
  constexpr std::size_t kMostSides = 32;
  const std::size_t end = value.find(')');
  if (!value.starts_with('(') || end == std::string_view::npos) {
    throw InputError("is no NumPy array: its 'shape' is no tuple");
  }
  for (std::string_view rest = without_blanks(value.substr(1, end - 1)); !rest.empty();) {
    std::uint64_t side = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), side);
    rest = without_blanks(rest.substr(static_cast<std::size_t>(stop - rest.data())));
    rest.remove_prefix(rest.starts_with('L') ? 1 : 0);  // as Python 2 wrote
    if (error != std::errc() || (!rest.empty() && rest[0] != ',') || shape_.size() == kMostSides) {
      throw InputError("is no NumPy array: its 'shape' is no tuple of numbers");
    }
    rest = without_blanks(rest.substr(rest.empty() ? 0 : 1));
    shape_.push_back(side);
  }
}

std::string NpyArray::shape_text() const {
  return shape_.empty() ? "one number" : fmt::format("{}", fmt::join(shape_, " x "));
}

std::uint64_t NpyArray::columns() const {
  return shape_.size() < 2 ? 1 : shape_.back();
}

std::uint64_t NpyArray::rows() const {
  const std::size_t sides = shape_.size() < 2 ? shape_.size() : shape_.size() - 1;
  std::uint64_t rows = 1;
  for (std::size_t i = 0; i < sides; ++i) {
    rows *= shape_[i];
  }
  return rows;
}

double NpyArray::at(std::uint64_t row, std::uint64_t column) const {
  const std::uint64_t index = columns_first_ ? column * rows() + row : row * columns() + column;
  const char* number = numbers_.data() + index * size_;
  return is_half_ ? from_half(load<std::uint16_t>(number, order_)) : load_scalar(number, type_, order_);
}

}  // namespace spincat::io
