#include "spincat/camera/source/name_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "spincat/error.h"

namespace spincat {
namespace {

constexpr std::size_t kMostBytes = 1'000'000;
constexpr std::size_t kMostDepth = 32;
constexpr std::size_t kMostEntries = 20'000;
constexpr std::size_t kMostName = 64;
constexpr std::size_t kMostNumbers = 17;  // one more than the largest matrix has

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

std::string name_of(std::string_view text) {
  std::string name(without_blanks(text).substr(0, kMostName));
  for (char& c : name) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name;
}

std::optional<double> number_of(std::string_view word) {
  double value = 0.0;
  const char* const first = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* const end = word.data() + word.size();
  const auto [last, error] = std::from_chars(first, end, value);
  return error == std::errc{} && last == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// The first of the text's numbers, as many as a matrix may have.
std::vector<double> numbers_of(std::string_view text) {
  constexpr std::string_view kBetween = " \t,;()[]";
  std::vector<double> numbers;
  while (numbers.size() < kMostNumbers) {
    text.remove_prefix(std::min(text.find_first_not_of(kBetween), text.size()));
    if (text.empty()) {
      break;
    }
    const std::string_view word = text.substr(0, text.find_first_of(kBetween));
    if (const std::optional<double> number = number_of(word)) {
      numbers.push_back(*number);
    }
    text.remove_prefix(word.size());
  }
  return numbers;
}

class NameReader {
 public:
  explicit NameReader(bool (*is_wanted)(std::string_view)) : is_wanted_(is_wanted) { tree_.groups.emplace_back(); }

  void read_line(std::string_view line);
  NameTree take() {
    if (!brackets_.empty()) {
      throw InputError(fmt::format("line {}: '{}' is not closed", brackets_.back().line, brackets_.back().kind));
    }
    return std::move(tree_);
  }

 private:
  // A name that those under it belong to.
  struct Level {
    std::size_t indent = 0;
    std::string name;
    std::size_t group = 0;  // 0: nothing wanted was under it
  };
  struct Bracket {
    char kind;
    std::size_t line;
    std::size_t levels;  // before it
  };

  std::size_t begin_line(std::string_view line);
  std::size_t read_character(std::string_view line, std::size_t at);
  std::size_t read_quoted(std::string_view line, std::size_t at);
  bool ends_name(std::string_view line, std::size_t at) const;
  void add(char c);
  void close(char kind);
  void end_piece();
  void add_entry();
  void add_numbers();
  void push_level(std::string name);
  std::size_t group_here();
  bool in(char kind) const { return !brackets_.empty() && brackets_.back().kind == kind; }

  bool (*is_wanted_)(std::string_view);
  NameTree tree_;
  std::vector<Level> levels_;
  std::vector<Bracket> brackets_;
  std::size_t line_ = 0;
  std::size_t indent_ = 0;           // of the line, twice and one more; two more of a list's dash. 0: a section's
  std::optional<std::string> name_;  // of the piece that is read
  std::string text_;                 // of the piece: its name, and after that its value
  bool entry_open_ = false;          // numbers without a name are the last entry's
};

void NameReader::read_line(std::string_view line) {
  ++line_;
  std::size_t at = brackets_.empty() ? begin_line(line) : 0;
  while (at < line.size()) {
    at = read_character(line, at);
  }
  if (brackets_.empty()) {
    end_piece();
  } else {
    add(' ');
  }
}

// Outside brackets the line's indent tells whose it is. Returns where its text begins.
std::size_t NameReader::begin_line(std::string_view line) {
  const std::string_view all = without_blanks(line);
  if (all.starts_with('%') || all == "---" || all == "...") {  // of YAML: another document
    levels_.clear();
    return line.size();
  }
  if (all.empty() || all.front() == '#') {
    return line.size();
  }
  if (all.front() == '[' && all.back() == ']' && all.size() > 2 && numbers_of(all).empty()) {  // a section
    levels_.clear();
    levels_.push_back({0, name_of(all.substr(1, all.size() - 2)), 0});
    return line.size();
  }
  std::size_t at = line.find_first_not_of(" \t");
  const auto leave_levels = [&](std::size_t indent) {
    while (!levels_.empty() && levels_.back().indent >= indent) {
      levels_.pop_back();
    }
    indent_ = indent;
  };
  const auto is_dash = [&] {
    return at < line.size() && line[at] == '-' && (at + 1 == line.size() || is_blank(line[at + 1]));
  };
  bool is_item = false;
  while (is_dash()) {
    leave_levels(2 * at + 2);
    push_level("");
    is_item = true;
    at = std::min(line.find_first_not_of(" \t", at + 1), line.size());
  }
  if (!is_item || at < line.size()) {
    leave_levels(2 * at + 1);
  }
  return at;
}

// Returns where the next one is.
std::size_t NameReader::read_character(std::string_view line, std::size_t at) {
  const char c = line[at];
  const bool after_blank = at == 0 || is_blank(line[at - 1]);
  if (c == '#' && after_blank) {
    return line.size();
  }
  if (c == '"' || (c == '\'' && text_.empty())) {
    return read_quoted(line, at);
  }
  const bool is_text = brackets_.empty() && !name_ && !text_.empty();  // "Depth 640 x 480 {Z16}"
  if (c == '{' && !is_text) {
    const std::size_t before = levels_.size();
    push_level(name_.value_or(""));
    brackets_.push_back({c, line_, before});
    name_.reset();
    text_.clear();
  } else if (c == '[') {
    if (brackets_.size() >= kMostDepth) {
      throw InputError(fmt::format("line {}: more than {} brackets in each other", line_, kMostDepth));
    }
    brackets_.push_back({c, line_, levels_.size()});
    add(' ');
  } else if (c == '}' || c == ']') {
    close(c == '}' ? '{' : '[');
  } else if (c == ',' && in('{')) {
    end_piece();
  } else if (ends_name(line, at)) {
    name_ = name_of(text_);
    text_.clear();
  } else {
    add(c);
  }
  return at + 1;
}

// No blanks before the text: whether there is any is asked again and again.
void NameReader::add(char c) {
  if (!text_.empty() || !is_blank(c)) {
    text_ += c;
  }
}

std::size_t NameReader::read_quoted(std::string_view line, std::size_t at) {
  const char quote = line[at++];
  while (at < line.size() && line[at] != quote) {
    at += line[at] == '\\' && quote == '"' && at + 1 < line.size() ? 1 : 0;
    add(line[at++]);
  }
  return at + 1;
}

bool NameReader::ends_name(std::string_view line, std::size_t at) const {
  if (name_ || in('[')) {
    return false;
  }
  const bool is_last = at + 1 == line.size();
  return line[at] == '=' ||
         (line[at] == ':' &&
          (in('{') || is_last || std::string_view(" \t[{\"").find(line[at + 1]) != std::string_view::npos));
}

void NameReader::close(char kind) {
  if (!in(kind)) {
    return;  // of a text that only looks like one of ours
  }
  if (kind == '{') {
    end_piece();
    levels_.resize(brackets_.back().levels);
    entry_open_ = false;
  } else {
    add(' ');
  }
  brackets_.pop_back();
}

void NameReader::end_piece() {
  if (name_) {
    add_entry();
    if (brackets_.empty()) {
      push_level(*name_);
    }
  } else {
    add_numbers();
  }
  name_.reset();
  text_.clear();
}

void NameReader::add_entry() {
  const std::size_t dot = name_->rfind('.');
  const std::string name = name_->substr(dot == std::string::npos ? 0 : dot + 1);
  entry_open_ = is_wanted_(name);
  if (!entry_open_) {
    return;
  }
  if (tree_.entries.size() == kMostEntries) {
    throw InputError(fmt::format("line {}: more than {} numbers of cameras", line_, kMostEntries));
  }
  std::size_t group = group_here();
  if (dot != std::string::npos) {
    const std::string outer = name_->substr(0, dot);
    const NameTree::Group& last = tree_.groups.back();
    if (last.parent != group || last.name != outer || tree_.groups.size() == 1) {
      tree_.groups.push_back({group, outer});
    }
    group = tree_.groups.size() - 1;
  }
  tree_.entries.push_back({group, name, numbers_of(text_), line_});
}

// Of a line without a name: the last entry's, as in a list with an item a line; or a heading of what follows.
void NameReader::add_numbers() {
  const std::string_view words = without_blanks(text_);
  const std::vector<double> more = numbers_of(words);
  if (entry_open_ && !more.empty()) {
    std::vector<double>& numbers = tree_.entries.back().numbers;
    numbers.insert(numbers.end(), more.begin(),
                   more.begin() + static_cast<std::ptrdiff_t>(std::min(more.size(), kMostNumbers - numbers.size())));
  } else if (!words.empty() && more.empty() && brackets_.empty()) {
    push_level(name_of(words));
    entry_open_ = false;
  }
}

void NameReader::push_level(std::string name) {
  if (levels_.size() == kMostDepth) {
    throw InputError(fmt::format("line {}: more than {} groups in each other", line_, kMostDepth));
  }
  levels_.push_back({indent_, std::move(name), 0});
}

std::size_t NameReader::group_here() {
  std::size_t group = 0;
  for (Level& level : levels_) {
    if (level.group == 0) {
      tree_.groups.push_back({group, level.name});
      level.group = tree_.groups.size() - 1;
    }
    group = level.group;
  }
  return group;
}

}  // namespace

NameTree read_name_tree(std::string_view text, bool (*is_wanted)(std::string_view name)) {
  if (text.size() > kMostBytes) {
    throw InputError(fmt::format("is larger than {} bytes: no calibration", kMostBytes));
  }
  NameReader reader(is_wanted);
  text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    reader.read_line(text.substr(0, end));
    const bool is_pair = text.substr(end).starts_with("\r\n");
    text.remove_prefix(std::min(end + (is_pair ? 2 : 1), text.size()));
  }
  return reader.take();
}

}  // namespace spincat
