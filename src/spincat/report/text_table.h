// Tables of plain text, aligned.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spincat {

// How many columns of a terminal a UTF-8 text takes, by the C library's wcwidth: two for a wide character (CJK, emoji),
// none for one that combines with that before it.
std::size_t text_width(std::string_view text);

// `text` cut to `width` columns, or one less where a wide character would stand across the cut, by leaving out its
// middle ("very/lo…air.obj"); never inside a code point, and no accent without its letter.
std::string cut_in_the_middle(std::string_view text, std::size_t width);

// `text` with control characters, characters that change the direction of what follows, and what is no UTF-8 replaced
// by '?', so that a file's name cannot steer a terminal.
std::string printable(std::string_view text);

// `text` in lines of at most `width` columns, broken at blanks; a longer word keeps a line to itself. Every line but
// the first begins with `indent` blanks, which count. The text's own line breaks stay.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent = 0);

// The width of the widest line.
std::size_t widest_line(std::string_view text);

enum class Align { left, right };

// What stands in a cell, and how a terminal is to show it: an SGR code such as "1;34" (bold blue), or nothing.
struct Cell {
  Cell(std::string cell_text, std::string_view sgr = {})  // NOLINT(google-explicit-constructor): a text is a cell
      : text(std::move(cell_text)), style(sgr) {}
  Cell(const char* cell_text) : text(cell_text) {}  // NOLINT(google-explicit-constructor)

  std::string text;
  std::string_view style;
};

// Rows of cells under one head; every column as wide as its widest cell, two blanks between columns, no trailing
// blanks.
class TextTable {
 public:
  explicit TextTable(std::vector<Align> columns) : columns_(std::move(columns)) {}

  // One cell for each column.
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  // Styles are left out where `styled` is false.
  std::string str(bool styled = false) const;

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace spincat
