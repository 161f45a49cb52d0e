#include "spincat/io/text_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "spincat/error.h"

namespace spincat::io {
namespace {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
constexpr bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}
constexpr char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
}

// 0,5 or -1,25e3.
bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) {
    return false;
  }
  std::string number(word);
  number[comma] = '.';
  return is_number(number);
}

// What the number behind an 'e' comes to; the largest there is where it is larger.
std::int64_t exponent_value(std::string_view text) {
  constexpr std::int64_t kMost = std::int64_t{1} << 62;  // more than a file can have digits
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) {
    text.remove_prefix(1);
  }
  std::int64_t value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc::result_out_of_range) {
    value = kMost;
  }
  value = std::min(value, kMost);
  return negative ? -value : value;
}

// from_chars says "out of range" for 1e-999 as for 1e999; only the second is an error. The first digit that is no zero
// decides, and where the point is after all: 0.001e999 is large, 1000e-999 tiny, and 0 may stand before 400 digits.
bool is_tiny(std::string_view number) {
  const std::size_t digits_end = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, digits_end);
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) {
    return true;
  }
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::int64_t place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  return place + (digits_end < number.size() ? exponent_value(number.substr(digits_end + 1)) : 0) < 0;
}

}  // namespace

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 24;
  std::string result(text.substr(0, kLongest));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > kLongest ? result + "..." : result;
}

std::string in_quotes(std::string_view text) {
  return "'" + shown(text) + "'";
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return to_lower(x) == to_lower(y); });
}

bool is_number(std::string_view word) {
  const bool has_plus = word.starts_with('+') && !word.starts_with("+-");
  const char* first = word.data() + (has_plus ? 1 : 0);
  const char* end = word.data() + word.size();
  double value = 0;
  const auto [last, error] = std::from_chars(first, end, value);
  return error != std::errc::invalid_argument && last == end;
}

TextCursor::TextCursor(std::string_view text, TextStyle style, std::size_t first_line)
    : at_(text.data()), end_(text.data() + text.size()), line_(first_line), style_(style) {
  if (text.starts_with("\xEF\xBB\xBF")) {
    at_ += 3;  // a byte order mark, which some editors put before UTF-8
  }
}

bool TextCursor::is_comment(const char* at) const {
  return (style_.hash_comments && *at == '#') || (style_.slash_comments && *at == '/' && end_ - at > 1 && at[1] == '/');
}

// Goes past a \ with the line end behind it.
bool TextCursor::take_continuation() {
  if (!style_.backslash_continues || *at_ != '\\') {
    return false;
  }
  const char* behind = at_ + 1;
  while (behind != end_ && is_blank(*behind)) {
    ++behind;
  }
  if (behind == end_ || !is_line_end(*behind)) {
    return false;
  }
  at_ = behind;
  skip_line_end();
  return true;
}

bool TextCursor::word_on_line() {
  while (at_ != end_) {
    if (is_blank(*at_) || (style_.commas_separate && (*at_ == ',' || *at_ == ';'))) {
      ++at_;
    } else if (is_line_end(*at_)) {
      return false;
    } else if (is_comment(at_)) {
      while (at_ != end_ && !is_line_end(*at_)) {
        ++at_;
      }
    } else if (!take_continuation()) {
      return true;
    }
  }
  return false;
}

bool TextCursor::word_follows() {
  while (!word_on_line()) {
    if (at_ == end_) {
      return false;
    }
    skip_line_end();
  }
  return true;
}

// Called at a line end.
void TextCursor::skip_line_end() {
  if (*at_ == '\r' && end_ - at_ > 1 && at_[1] == '\n') {
    ++at_;
  }
  ++at_;
  ++line_;
}

void TextCursor::skip_line() {
  while (at_ != end_ && !is_line_end(*at_)) {
    ++at_;
  }
  if (at_ != end_) {
    skip_line_end();
  }
}

bool TextCursor::at_word_end(const char* at) const {
  return at == end_ || is_blank(*at) || is_line_end(*at) || is_comment(at) ||
         (style_.commas_separate && (*at == ',' || *at == ';')) || (style_.backslash_continues && *at == '\\');
}

std::string_view TextCursor::peek() {
  if (!word_on_line()) {
    return {};
  }
  const char* last = at_ + 1;
  while (!at_word_end(last)) {
    ++last;
  }
  return {at_, static_cast<std::size_t>(last - at_)};
}

std::string_view TextCursor::word() {
  const std::string_view found = peek();
  at_ += found.size();
  return found;
}

std::string_view TextCursor::rest_of_line() const {
  const char* last = std::find_if(at_, end_, is_line_end);
  return {at_, static_cast<std::size_t>(last - at_)};
}

double TextCursor::number(const char* what) {
  if (!word_on_line()) {
    fail_expecting(what);
  }
  const char* first = *at_ == '+' ? at_ + 1 : at_;  // which from_chars does not take
  double value = 0;
  const auto [last, error] = std::from_chars(first, end_, value);
  if (error == std::errc::invalid_argument || !at_word_end(last) || (first != at_ && *first == '-')) {
    fail_expecting(what);
  }
  if (error == std::errc::result_out_of_range) {
    if (!is_tiny({at_, static_cast<std::size_t>(last - at_)})) {
      fail(in_quotes(word()) + " is too large for a number");
    }
    value = 0;
  }
  at_ = last;
  return value;
}

double TextCursor::finite_number(const char* what) {
  const char* first = at_;
  const double value = number(what);
  if (!std::isfinite(value)) {
    at_ = first;
    fail(fmt::format("{} must be finite, found {}", what, in_quotes(word())));
  }
  return value;
}

std::int64_t TextCursor::integer(const char* what) {
  if (!word_on_line()) {
    fail_expecting(what);
  }
  const char* first = *at_ == '+' ? at_ + 1 : at_;
  std::int64_t value = 0;
  const auto [last, error] = std::from_chars(first, end_, value);
  if (error != std::errc() || !at_word_end(last) || (first != at_ && *first == '-')) {
    fail_expecting(what);
  }
  at_ = last;
  return value;
}

std::uint64_t TextCursor::count(const char* what) {
  const char* first = at_;
  const std::int64_t value = integer(what);
  if (value < 0) {
    at_ = first;
    fail_expecting(what);
  }
  return static_cast<std::uint64_t>(value);
}

void TextCursor::fail(const std::string& problem) const {
  throw InputError(fmt::format("line {}: {}", line_, problem));
}

void TextCursor::fail_expecting(const char* what) {
  if (word_on_line()) {
    const std::string_view found = word();
    fail(fmt::format("expected {}, found {}{}", what, in_quotes(found),
                     has_decimal_comma(found) ? " (a point is the decimal mark, not a comma)" : ""));
  }
  fail(fmt::format("expected {}, but the {} ends here", what, at_ == end_ ? "file" : "line"));
}

}  // namespace spincat::io
