// Private to this folder, not installed: a small reader of CSV tables by RFC 4180.
//
// Beyond the RFC: a byte-order mark is passed over, lines that start with # are comments, empty lines are skipped, and
// lines may end with LF, CRLF or CR. Spaces belong to the field that they stand in, as the RFC has it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spincat {

struct CsvRow {
  std::size_t line = 0;  // where the row begins, counted from 1
  std::vector<std::string> fields;
};

// Throws InputError(file, "line N: ...") for quotes that do not fit together and for bytes that no text holds.
std::vector<CsvRow> parse_csv(std::string_view text, const std::string& file);

// A table whose first row names its columns; every other row has as many fields.
struct CsvTable {
  std::string file;  // for messages
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;

  std::optional<std::size_t> find_column(std::string_view name) const;
  // Throws InputError when there is no such column.
  std::size_t column(std::string_view name) const;
  // A field that may not be empty. Throws InputError with its line when it is.
  const std::string& filled(const CsvRow& row, std::size_t column) const;
};

CsvTable read_csv_table(const std::filesystem::path& file);

}  // namespace spincat
