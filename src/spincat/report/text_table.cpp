#include "spincat/report/text_table.h"

#include <locale.h>  // NOLINT(modernize-deprecated-headers): newlocale is POSIX
#include <wchar.h>   // NOLINT(modernize-deprecated-headers): and so is wcwidth

#include <algorithm>
#include <cwchar>

namespace spincat {
namespace {

bool begins_code_point(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

// The bytes from one begin of a code point to the next.
std::string_view first_code_point(std::string_view text) {
  std::size_t end = 1;
  while (end < text.size() && !begins_code_point(text[end])) {
    ++end;
  }
  return text.substr(0, end);
}

// Columns of one code point; 1 for what is none.
std::size_t columns_of(std::string_view code_point) {
  if (code_point.size() == 1) {
    return 1;
  }
  // Not the user's locale: names are UTF-8 whatever that says.
  static const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", locale_t{});
  if (utf8 == locale_t{}) {
    return 1;
  }
  const locale_t before = uselocale(utf8);
  wchar_t character = 0;
  std::mbstate_t state{};
  const std::size_t used = std::mbrtowc(&character, code_point.data(), code_point.size(), &state);
  const int columns = used == code_point.size() ? wcwidth(character) : -1;
  uselocale(before);
  return columns < 0 ? 1 : static_cast<std::size_t>(columns);
}

// As much of the beginning of `text` as fits `width` columns, with all that combines with its last letter.
std::string_view head_of(std::string_view text, std::size_t width) {
  std::size_t end = 0;
  for (std::size_t column = 0; end < text.size();) {
    const std::string_view next = first_code_point(text.substr(end));
    column += columns_of(next);
    if (column > width) {
      break;
    }
    end += next.size();
  }
  return text.substr(0, end);
}

// As much of the end as fits; it does not begin with what combines with the letter before it.
std::string_view tail_of(std::string_view text, std::size_t width) {
  for (std::size_t columns = text_width(text);
       columns > width || (!text.empty() && columns_of(first_code_point(text)) == 0);) {
    const std::string_view first = first_code_point(text);
    columns -= columns_of(first);
    text.remove_prefix(first.size());
  }
  return text;
}

// U+0080 to U+009F, which terminals obey as they do ESC and what follows it.
bool is_upper_control(std::string_view text) {
  return text.size() >= 2 && text[0] == '\xC2' && static_cast<unsigned char>(text[1]) < 0xA0U &&
         !begins_code_point(text[1]);
}

// U+202A to U+202E and U+2066 to U+2069: what follows them runs the other way until somebody says stop.
bool is_direction(std::string_view text) {
  if (text.size() < 3 || text[0] != '\xE2') {
    return false;
  }
  const auto second = static_cast<unsigned char>(text[1]);
  const auto third = static_cast<unsigned char>(text[2]);
  return (second == 0x80U && third >= 0xAAU && third <= 0xAEU) || (second == 0x81U && third >= 0xA6U && third <= 0xA9U);
}

// The bytes of the character that `text` begins with; 0 when it is a control character or no UTF-8.
std::size_t printable_bytes(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80U) {
    return lead < 0x20U || lead == 0x7FU ? 0 : 1;
  }
  const std::size_t bytes = lead >= 0xF5U ? 0 : lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : lead >= 0xC2U ? 2 : 0;
  if (bytes == 0 || text.size() < bytes || is_upper_control(text)) {
    return 0;
  }
  return std::ranges::none_of(text.substr(1, bytes - 1), begins_code_point) ? bytes : 0;
}

}  // namespace

std::size_t text_width(std::string_view text) {
  std::size_t columns = 0;
  while (!text.empty()) {
    const std::string_view next = first_code_point(text);
    columns += columns_of(next);
    text.remove_prefix(next.size());
  }
  return columns;
}

std::string cut_in_the_middle(std::string_view text, std::size_t width) {
  if (text_width(text) <= width) {
    return std::string(text);
  }
  if (width == 0) {
    return {};
  }
  const std::size_t head = (width - 1) / 2;
  std::string cut(head_of(text, head));
  cut += "…";
  cut += tail_of(text, width - 1 - head);
  return cut;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = is_direction(text) ? 0 : printable_bytes(text);
    result += length > 0 ? text.substr(0, length) : "?";
    const std::size_t replaced = is_direction(text) ? 3 : is_upper_control(text) ? 2 : 1;
    text.remove_prefix(std::max(length, replaced));
  }
  return result;
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result;
  std::size_t column = 0;
  bool line_begins = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    const std::string_view word = text.substr(0, end);
    const bool fits = column + (line_begins ? 0 : 1) + text_width(word) <= width;
    if (!fits && !line_begins) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!line_begins) {
      result += " ";
      ++column;
    }
    result += word;
    column += text_width(word);
    line_begins = false;
    if (end < text.size() && text[end] == '\n') {
      result += "\n" + std::string(end + 1 < text.size() ? indent : 0, ' ');
      column = indent;
      line_begins = true;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

std::size_t widest_line(std::string_view text) {
  std::size_t widest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    widest = std::max(widest, text_width(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return widest;
}

std::string TextTable::str(bool styled) const {
  std::vector<std::size_t> widths(columns_.size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], text_width(row[c].text));
    }
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - text_width(row[c].text), ' ');
      const bool plain = !styled || row[c].style.empty();
      const std::string shown =
          plain ? row[c].text : "\033[" + std::string(row[c].style) + "m" + row[c].text + "\033[0m";
      line += (c > 0 ? "  " : "") + (columns_[c] == Align::right ? blanks + shown : shown + blanks);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace spincat
