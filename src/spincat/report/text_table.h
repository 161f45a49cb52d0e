// Tables of plain text, aligned.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spincat {

// How many columns of a terminal a UTF-8 text takes: one a code point (wide and combining characters are not known
// here).
std::size_t text_width(std::string_view text);

// `text` cut to `width` columns by leaving out its middle ("very/lo…air.obj"), never inside a code point.
std::string cut_in_the_middle(std::string_view text, std::size_t width);

// `text` with control characters and what is no UTF-8 replaced by '?', so that a file's name cannot steer a terminal.
std::string printable(std::string_view text);

enum class Align { left, right };

// Rows of cells under one head; every column as wide as its widest cell, two blanks between columns, no trailing
// blanks.
class TextTable {
 public:
  explicit TextTable(std::vector<Align> columns) : columns_(std::move(columns)) {}

  // One cell for each column.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string str() const;

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace spincat
