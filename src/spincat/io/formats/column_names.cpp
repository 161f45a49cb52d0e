#include "spincat/io/formats/column_names.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using namespace std::string_view_literals;

// More columns than that are no table that somebody would read as points.
constexpr std::size_t kMostColumns = 1'000;

// "nx" of "NX", "\"nx\"" or "nx[m]".
std::string plain_name(std::string_view word) {
  std::string name;
  for (const char c : word.substr(0, std::min(word.find_first_of("[("), word.size()))) {
    if (c != '"' && c != '\'') {
      name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
  }
  return name;
}

std::vector<std::string> names_of(std::string_view line) {
  TextCursor text(line, {.hash_comments = false, .commas_separate = true});
  std::vector<std::string> names;
  while (text.word_on_line() && names.size() < kMostColumns) {
    if (std::string name = plain_name(text.word()); !name.empty()) {  // empty: a unit, as in "x (m)"
      names.push_back(std::move(name));
    }
  }
  return names;
}

// The number of a name among x, y, z, nx, ny, nz; 6 for others.
std::size_t role_of(std::string_view name) {
  static constexpr std::array kPoint = {"x"sv, "y"sv, "z"sv, "points:0"sv, "points:1"sv, "points:2"sv};
  static constexpr std::array kNormal = {"nx"sv,       "ny"sv,        "nz"sv,        "normal_x"sv,
                                         "normal_y"sv, "normal_z"sv,  "normalx"sv,   "normaly"sv,
                                         "normalz"sv,  "normals:0"sv, "normals:1"sv, "normals:2"sv};
  const auto point = static_cast<std::size_t>(std::ranges::find(kPoint, name) - kPoint.begin());
  const auto normal = static_cast<std::size_t>(std::ranges::find(kNormal, name) - kNormal.begin());
  if (point < kPoint.size()) {
    return point % 3;
  }
  return normal < kNormal.size() ? 3 + normal % 3 : 6;
}

bool is_in_use(std::string_view name) {
  static constexpr std::array kOthers = {"r"sv,
                                         "g"sv,
                                         "b"sv,
                                         "a"sv,
                                         "red"sv,
                                         "green"sv,
                                         "blue"sv,
                                         "alpha"sv,
                                         "rgb"sv,
                                         "rgba"sv,
                                         "i"sv,
                                         "int"sv,
                                         "intensity"sv,
                                         "reflectance"sv,
                                         "label"sv,
                                         "class"sv,
                                         "classification"sv,
                                         "instance"sv,
                                         "id"sv,
                                         "index"sv,
                                         "t"sv,
                                         "time"sv,
                                         "timestamp"sv,
                                         "gps_time"sv,
                                         "gpstime"sv,
                                         "ring"sv,
                                         "u"sv,
                                         "v"sv,
                                         "scalar"sv,
                                         "curvature"sv,
                                         "confidence"sv,
                                         "quality"sv,
                                         "range"sv,
                                         "distance"sv,
                                         "return_number"sv};
  return role_of(name) < 6 || std::ranges::find(kOthers, name) != kOthers.end();
}

std::optional<ColumnNames> columns_called(const std::vector<std::string>& names) {
  ColumnNames columns;
  columns.columns = names.size();
  std::array<bool, 6> found{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t role = role_of(names[i]);
    if (role < 6 && !found[role]) {
      found[role] = true;
      columns.places[role] = i;
    }
  }
  columns.has_normals = found[3] && found[4] && found[5];
  return found[0] && found[1] && found[2] ? std::optional(columns) : std::nullopt;
}

}  // namespace

std::optional<ColumnNames> column_names(std::string_view line) {
  return columns_called(names_of(line));
}

std::optional<ColumnNames> column_names_in_comments(std::string_view text) {
  TextCursor lines(text, {.hash_comments = false});
  for (; lines.word_follows(); lines.skip_line()) {
    const std::string_view line = lines.rest_of_line();
    const std::size_t mark = line.starts_with("//") ? 2 : line.find_first_not_of('#');
    if (mark == 0) {
      break;
    }
    const std::vector<std::string> names = names_of(line.substr(std::min(mark, line.size())));
    if (std::ranges::all_of(names, is_in_use)) {
      if (auto columns = columns_called(names)) {
        columns->line = lines.line();
        return columns;
      }
    }
  }
  return std::nullopt;
}

}  // namespace spincat::io
