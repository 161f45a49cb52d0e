#include "spincat/dataset/csv_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "spincat/dataset/words.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/files/text_encoding.h"

namespace spincat {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kMostFields = 1'000;

std::string text_of(const std::filesystem::path& file) {
  std::string bytes = read_file(file);
  auto text = naming_file(file, [&] { return utf8_of_utf16(bytes); });
  return text ? *std::move(text) : std::move(bytes);
}

// "sep=;" as a first line is no row: a spreadsheet says so what separates the fields. Its length without the line end;
// 0 where there is none.
std::size_t length_of_separator_line(std::string_view text) {
  constexpr std::string_view kBegin = "sep=";
  const std::size_t length = kBegin.size() + 1;
  const bool is_there =
      text.starts_with(kBegin) && text.size() > length && (text[length] == '\n' || text[length] == '\r');
  return is_there ? length : 0;
}

// The text up to the end of its first row. Comments and empty lines stand before it.
std::string_view first_row(std::string_view text) {
  bool quoted = false;
  bool is_comment = false;
  std::size_t begin = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  begin += length_of_separator_line(text.substr(begin));
  for (std::size_t at = begin; at < text.size(); ++at) {
    const bool ends_line = (text[at] == '\n' || text[at] == '\r') && !quoted;
    is_comment = is_comment || (at == begin && text[at] == '#');
    quoted = quoted != (text[at] == '"' && !is_comment);
    if (ends_line && at > begin && !is_comment) {
      return text.substr(begin, at - begin);
    }
    if (ends_line) {
      begin = at + 1;
      is_comment = false;
    }
  }
  return text.substr(begin);
}

// The most frequent outside quotes.
char separator_of(std::string_view row) {
  static constexpr std::string_view kSeparators = ",;\t";
  std::array<std::size_t, kSeparators.size()> found{};
  bool quoted = false;
  for (const char c : row) {
    quoted = quoted != (c == '"');
    if (const std::size_t place = kSeparators.find(c); place < found.size() && !quoted) {
      ++found[place];
    }
  }
  return kSeparators[static_cast<std::size_t>(std::ranges::max_element(found) - found.begin())];
}

std::string plain_name(std::string_view name) {
  const std::size_t first = name.find_first_not_of(' ');
  std::string result(first == std::string_view::npos ? "" : name.substr(first, name.find_last_not_of(' ') + 1 - first));
  std::ranges::transform(result, result.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

}  // namespace

CsvParser::CsvParser(std::string_view text, const std::string& file, char separator)
    : text_(text), file_(file), separator_(separator) {
  if (text_.starts_with(kByteOrderMark)) {
    at_ = kByteOrderMark.size();
  }
  at_ += length_of_separator_line(text_.substr(at_));
}

std::optional<CsvRow> CsvParser::next() {
  while (!at_end()) {
    if (text_[at_] == '#') {
      skip_comment();
    } else if (!take_line_end()) {
      return row();
    }
  }
  return std::nullopt;
}

void CsvParser::fail(std::size_t line, std::string_view problem) const {
  throw InputError(file_, at_line(line, problem));
}

// Takes LF, CRLF or CR, if one is next.
bool CsvParser::take_line_end() {
  if (!at_line_end()) {
    return false;
  }
  at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  ++line_;
  return true;
}

void CsvParser::skip_comment() {
  while (!at_end() && !take_line_end()) {
    ++at_;
  }
}

CsvRow CsvParser::row() {
  CsvRow result{line_, {}};
  while (true) {
    if (result.fields.size() == kMostFields) {
      fail(result.line, fmt::format("a row of more than {} fields", kMostFields));
    }
    const bool quotes = !at_end() && text_[at_] == '"';
    result.fields.push_back(quotes ? quoted_field() : plain_field());
    if (at_end() || take_line_end()) {
      return result;
    }
    ++at_;  // the separator
  }
}

std::string CsvParser::plain_field() {
  const std::size_t begin = at_;
  while (!at_end() && text_[at_] != separator_ && !at_line_end()) {
    if (text_[at_] == '"') {
      fail(line_, "a quote inside a field (put quotes around the field and write \"\" for one inside)");
    }
    check_byte();
    ++at_;
  }
  return std::string(text_.substr(begin, at_ - begin));
}

std::string CsvParser::quoted_field() {
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
void CsvParser::take_quoted_byte(std::string& field) {
  check_byte();
  const std::size_t begin = at_;
  if (!take_line_end()) {
    ++at_;
  }
  field += text_.substr(begin, at_ - begin);
}

void CsvParser::check_after_quote() const {
  if (!at_end() && text_[at_] != separator_ && !at_line_end()) {
    fail(line_, "text after the closing quote of a field");
  }
}

void CsvParser::check_byte() const {
  if (text_[at_] == '\0') {
    fail(line_, "a zero byte: this is no plain text (expected UTF-8)");
  }
}

CsvTable::CsvTable(const std::filesystem::path& file)
    : file_(file.string()), text_(text_of(file)), parser_(text_, file_, separator_of(first_row(text_))) {
  std::optional<CsvRow> header = parser_.next();
  if (!header) {
    throw InputError(file_, "is empty (expected a header line that names the columns)");
  }
  columns_ = std::move(header->fields);
  for (auto name = columns_.begin(); name != columns_.end(); ++name) {
    if (!name->empty() && std::find(columns_.begin(), name, *name) != name) {
      throw InputError(file_, at_line(header->line, fmt::format("two columns are called {}", in_quotes(*name))));
    }
  }
}

std::optional<std::size_t> CsvTable::find_column(std::string_view name) const {
  const auto found = std::ranges::find(columns_, name, plain_name);
  return found == columns_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - columns_.begin()));
}

std::optional<std::size_t> CsvTable::find_column(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    if (const auto found = find_column(name)) {
      return found;
    }
  }
  return std::nullopt;
}

std::size_t CsvTable::column(std::initializer_list<std::string_view> names) const {
  if (const auto found = find_column(names)) {
    return *found;
  }
  std::vector<std::string> found;
  std::transform(columns_.begin(), columns_.end(), std::back_inserter(found), in_quotes);
  throw InputError(file_,
                   fmt::format("the header line names no column {} (found: {}; commas, semicolons or tabs separate "
                               "columns)",
                               in_quotes(*names.begin()), shown(fmt::to_string(fmt::join(found, ", ")))));
}

std::optional<CsvRow> CsvTable::next() {
  std::optional<CsvRow> row = parser_.next();
  if (row && row->fields.size() != columns_.size()) {
    throw InputError(file_,
                     at_line(row->line, fmt::format("{} field{}, expected {} as in the header line", row->fields.size(),
                                                    row->fields.size() == 1 ? "" : "s", columns_.size())));
  }
  return row;
}

const std::string& CsvTable::filled(const CsvRow& row, std::size_t column) const {
  const std::string& field = row.fields[column];
  if (field.empty()) {
    throw InputError(file_, at_line(row.line, fmt::format("the {} is empty", columns_[column])));
  }
  return field;
}

}  // namespace spincat
