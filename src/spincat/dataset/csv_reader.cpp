#include "spincat/dataset/csv_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "spincat/dataset/words.h"
#include "spincat/error.h"
#include "spincat/io/file.h"

namespace spincat {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class CsvParser {
 public:
  CsvParser(std::string_view text, const std::string& file) : text_(text), file_(file) {
    if (text_.starts_with(kByteOrderMark)) {
      at_ = kByteOrderMark.size();
    }
  }

  std::vector<CsvRow> rows() {
    std::vector<CsvRow> result;
    while (!at_end()) {
      if (text_[at_] == '#') {
        skip_comment();
      } else if (!take_line_end()) {
        result.push_back(row());
      }
    }
    return result;
  }

 private:
  bool at_end() const { return at_ == text_.size(); }
  bool at_line_end() const { return text_[at_] == '\n' || text_[at_] == '\r'; }

  [[noreturn]] void fail(std::size_t line, std::string_view problem) const {
    throw InputError(file_, at_line(line, problem));
  }

  // Takes LF, CRLF or CR, if one is next.
  bool take_line_end() {
    if (!at_line_end()) {
      return false;
    }
    at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
    ++line_;
    return true;
  }

  void skip_comment() {
    while (!at_end() && !take_line_end()) {
      ++at_;
    }
  }

  CsvRow row() {
    CsvRow result{line_, {}};
    while (true) {
      const bool quotes = !at_end() && text_[at_] == '"';
      result.fields.push_back(quotes ? quoted_field() : plain_field());
      if (at_end() || take_line_end()) {
        return result;
      }
      ++at_;  // the comma
    }
  }

  std::string plain_field() {
    const std::size_t begin = at_;
    while (!at_end() && text_[at_] != ',' && !at_line_end()) {
      if (text_[at_] == '"') {
        fail(line_, "a quote inside a field (put quotes around the field and write \"\" for one inside)");
      }
      check_byte();
      ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::string quoted_field() {
    const std::size_t first_line = line_;
    std::string field;
    ++at_;
    while (!at_end()) {
      if (text_[at_] == '"') {
        if (text_.substr(at_, 2) != "\"\"") {
          ++at_;
          check_after_quote();
          return field;
        }
        ++at_;
      }
      take_quoted_byte(field);
    }
    fail(first_line, "the quoted field that begins here never ends");
  }

  // Line ends inside quotes are kept as they are, and counted.
  void take_quoted_byte(std::string& field) {
    check_byte();
    const std::size_t begin = at_;
    if (!take_line_end()) {
      ++at_;
    }
    field += text_.substr(begin, at_ - begin);
  }

  void check_after_quote() const {
    if (!at_end() && text_[at_] != ',' && !at_line_end()) {
      fail(line_, "text after the closing quote of a field");
    }
  }

  void check_byte() const {
    if (text_[at_] == '\0') {
      fail(line_, "a zero byte: this is no plain text (expected UTF-8)");
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

void check_columns(const CsvTable& table, std::size_t line) {
  for (auto name = table.columns.begin(); name != table.columns.end(); ++name) {
    if (!name->empty() && std::find(table.columns.begin(), name, *name) != name) {
      throw InputError(table.file, at_line(line, fmt::format("two columns are called {}", in_quotes(*name))));
    }
  }
  for (const CsvRow& row : table.rows) {
    if (row.fields.size() != table.columns.size()) {
      throw InputError(table.file,
                       at_line(row.line, fmt::format("{} field{}, expected {} as in the header line", row.fields.size(),
                                                     row.fields.size() == 1 ? "" : "s", table.columns.size())));
    }
  }
}

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text, const std::string& file) {
  return CsvParser(text, file).rows();
}

std::optional<std::size_t> CsvTable::find_column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  return found == columns.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - columns.begin()));
}

std::size_t CsvTable::column(std::string_view name) const {
  if (const auto found = find_column(name)) {
    return *found;
  }
  std::vector<std::string> names;
  std::transform(columns.begin(), columns.end(), std::back_inserter(names), in_quotes);
  throw InputError(file, fmt::format("the header line names no column {} (found: {}; commas separate columns)",
                                     in_quotes(name), fmt::join(names, ", ")));
}

const std::string& CsvTable::filled(const CsvRow& row, std::size_t column) const {
  const std::string& field = row.fields[column];
  if (field.empty()) {
    throw InputError(file, at_line(row.line, fmt::format("the {} is empty", columns[column])));
  }
  return field;
}

CsvTable read_csv_table(const std::filesystem::path& file) {
  CsvTable table;
  table.file = file.string();
  table.rows = parse_csv(read_file(file), table.file);
  if (table.rows.empty()) {
    throw InputError(table.file, "is empty (expected a header line that names the columns)");
  }
  const std::size_t header_line = table.rows.front().line;
  table.columns = std::move(table.rows.front().fields);
  table.rows.erase(table.rows.begin());
  check_columns(table, header_line);
  return table;
}

}  // namespace spincat
