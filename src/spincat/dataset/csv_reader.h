// A small reader of CSV tables by RFC 4180.
//
// Beyond the RFC: semicolons or tabs may separate the fields (CsvTable finds out), a byte-order mark is passed over,
// lines that start with # are comments, empty lines are skipped, and lines may end with LF, CRLF or CR. Spaces belong
// to the field that they stand in, as the RFC has it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spincat {

struct CsvRow {
  std::size_t line = 0;  // where the row begins, counted from 1
  std::vector<std::string> fields;
};

// Takes a text apart row by row. The text and the file's name, which is for messages, must outlive it.
class CsvParser {
 public:
  CsvParser(std::string_view text, const std::string& file, char separator = ',');

  // The next row; nothing after the last one. Throws InputError(file, "line N: ...") for quotes that do not fit
  // together, for bytes that no text holds, and for rows of more than 1,000 fields.
  std::optional<CsvRow> next();

 private:
  bool at_end() const { return at_ == text_.size(); }
  bool at_line_end() const { return text_[at_] == '\n' || text_[at_] == '\r'; }
  [[noreturn]] void fail(std::size_t line, std::string_view problem) const;
  bool take_line_end();
  void skip_comment();
  CsvRow row();
  std::string plain_field();
  std::string quoted_field();
  void take_quoted_byte(std::string& field);
  void check_after_quote() const;
  void check_byte() const;

  std::string_view text_;
  const std::string& file_;
  char separator_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

// A table whose first row names its columns; every other row has as many fields. Whichever of comma, semicolon and tab
// is most often in that row separates the fields. Text in UTF-16 is read, too. Its rows are not kept.
class CsvTable {
 public:
  // Reads the file and its header line. Throws InputError.
  explicit CsvTable(const std::filesystem::path& file);
  CsvTable(const CsvTable&) = delete;
  CsvTable& operator=(const CsvTable&) = delete;

  const std::string& file() const { return file_; }
  std::size_t file_size() const { return text_.size(); }
  // The column of that name, upper or lower case; of several names, that of the first that is there.
  std::optional<std::size_t> find_column(std::string_view name) const;
  std::optional<std::size_t> find_column(std::initializer_list<std::string_view> names) const;
  // Throw InputError, which speaks of the first name, when there is no such column.
  std::size_t column(std::string_view name) const { return column({name}); }
  std::size_t column(std::initializer_list<std::string_view> names) const;

  // The next row; nothing after the last one. Throws InputError as CsvParser does, and for a row of another length.
  std::optional<CsvRow> next();
  // A field that may not be empty. Throws InputError with its line when it is.
  const std::string& filled(const CsvRow& row, std::size_t column) const;

 private:
  std::string file_;
  std::string text_;
  CsvParser parser_;
  std::vector<std::string> columns_;
};

}  // namespace spincat
