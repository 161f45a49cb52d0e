#include "spincat/report/text_table.h"

#include <algorithm>

namespace spincat {
namespace {

bool begins_code_point(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

// The first `count` code points of `text`.
std::string_view first_code_points(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end) {
    if (begins_code_point(text[end]) && ++seen > count) {
      break;
    }
  }
  return text.substr(0, end);
}

std::string_view last_code_points(std::string_view text, std::size_t count) {
  return text.substr(first_code_points(text, text_width(text) - count).size());
}

// U+0080 to U+009F, which terminals obey as they do ESC and what follows it.
bool is_upper_control(std::string_view text) {
  return text.size() >= 2 && text[0] == '\xC2' && static_cast<unsigned char>(text[1]) < 0xA0U &&
         !begins_code_point(text[1]);
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
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_code_point));
}

std::string cut_in_the_middle(std::string_view text, std::size_t width) {
  if (text_width(text) <= width) {
    return std::string(text);
  }
  if (width == 0) {
    return {};
  }
  const std::size_t head = (width - 1) / 2;
  std::string cut(first_code_points(text, head));
  cut += "…";
  cut += last_code_points(text, width - 1 - head);
  return cut;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = printable_bytes(text);
    result += length > 0 ? text.substr(0, length) : "?";
    text.remove_prefix(std::max<std::size_t>(length, is_upper_control(text) ? 2 : 1));
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
