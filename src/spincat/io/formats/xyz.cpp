// Columns of numbers, a point a line: x y z, and maybe a normal, a colour or an intensity.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "spincat/geometry/object.h"
#include "spincat/io/formats/column_names.h"
#include "spincat/io/formats/decimal_commas.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/rows.h"
#include "spincat/io/formats/unit_normals.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

constexpr TextStyle kStyle = {.slash_comments = true, .commas_separate = true};

std::string_view without_comment(std::string_view line) {
  return line.substr(0, std::min({line.find('#'), line.find("//"), line.size()}));
}

// Sees to it that commas mean the same in all lines, and turns decimal commas into points.
class DecimalMarks {
 public:
  // The line with points, where it has decimal commas; else nothing.
  std::optional<std::string> with_points(const TextCursor& text) {
    const std::string_view line = without_comment(text.rest_of_line());
    const Commas commas = commas_in(line);
    if (commas == Commas::unclear) {
      text.fail("a comma may part numbers or be a decimal mark here, found " + in_quotes(line));
    }
    if (commas == Commas::decimal) {
      comma_line_ = text.line();
    } else if (other_line_ == 0 && (commas == Commas::separate || line.find('.') != std::string_view::npos)) {
      other_line_ = text.line();
    }
    if (comma_line_ != 0 && other_line_ != 0) {
      text.fail(fmt::format("the comma is a decimal mark in line {} but not in line {}", comma_line_, other_line_));
    }
    return commas == Commas::decimal ? std::optional(replaced(line)) : std::nullopt;
  }

 private:
  static std::string replaced(std::string_view line) {
    std::string result(line);
    std::ranges::replace(result, ',', '.');
    return result;
  }

  std::size_t comma_line_ = 0;  // the last with a decimal comma
  std::size_t other_line_ = 0;  // the first with a decimal point, or with commas that part numbers
};

// Sees to it that no row has a value more or less than the first has: one too many, or one that is missing, moves those
// behind it to wrong columns. A whole normal or colour may be missing, and what is no number may be of several words.
class RowWidths {
 public:
  // To be called behind the coordinates; how many words follow them.
  std::size_t check(const TextCursor& row) {
    const std::size_t words = words_on_line(row);
    const std::string_view rest = without_comment(row.rest_of_line());
    const auto separators =
        static_cast<std::size_t>(std::ranges::count_if(rest, [](char c) { return c == ',' || c == ';'; }));
    const Width width{separators > 0, separators > 0 ? separators : words};
    if (line_ == 0) {
      first_ = width;
      line_ = row.line();
    } else if (width.separated == first_.separated && width.values != first_.values) {
      const bool is_more = width.values > first_.values;
      if ((is_more ? width.values - first_.values : first_.values - width.values) == 1 && all_numbers(row)) {
        row.fail(fmt::format("one value {} than in line {}", is_more ? "more" : "less", line_));
      }
    }
    return words;
  }

 private:
  struct Width {
    bool separated = false;  // by commas or semicolons, between which there may be nothing
    std::size_t values = 0;
  };

  static bool all_numbers(TextCursor row) {
    while (row.word_on_line()) {
      if (!is_number(row.word())) {
        return false;
      }
    }
    return true;
  }

  Width first_;
  std::size_t line_ = 0;  // of the first row
};

class XyzReader {
 public:
  XyzReader(std::string_view bytes, const ReadLimits& limits)
      : text_(bytes, kStyle), object_(limits), names_(column_names_in_comments(bytes)) {}

  Object read() {
    take_names();
    take_count();
    take_names();
    for (; text_.word_follows() && !is_padding_only(); text_.skip_line()) {
      if (!begins_scan()) {
        read_line();
        ++rows_;
      }
    }
    check_complete("file ends");
    if (!normals_.found() && !named_normals()) {
      object_.forget_normals();
    }
    return object_.finish();
  }

 private:
  bool named_normals() const { return names_ && names_->has_normals; }

  // A line above all points that begins with no number and names x, y and z.
  void take_names() {
    if (names_ || !text_.word_follows() || is_number(text_.peek())) {
      return;
    }
    names_ = column_names(text_.rest_of_line());
    if (names_) {
      names_->line = text_.line();
      text_.skip_line();
    }
  }

  // A first line that is a lone number says how many points follow (.pts).
  void take_count() {
    if (text_.word_follows() && words_on_line(text_) == 1) {
      count_line_ = text_.line();
      announced_ = text_.count("the number of points or three coordinates");
      text_.skip_line();
    }
  }

  // Whether this line is the count of another scan: where one has a count, each may have one.
  bool begins_scan() {
    if (!announced_ || rows_ < *announced_) {
      return false;
    }
    if (words_on_line(text_) != 1) {
      text_.fail(fmt::format("more than the {} points that line {} announces", *announced_, count_line_));
    }
    count_line_ = text_.line();
    announced_ = text_.count("the number of points or three coordinates");
    rows_ = 0;
    return true;
  }

  void check_complete(const char* what) const {
    if (announced_ && *announced_ > rows_) {
      text_.fail(fmt::format("the {} after {} of {} points", what, rows_, *announced_));
    }
  }

  bool is_padding_only() const {
    const std::string_view rest = text_.rest();
    return (rest[0] == '\0' || rest[0] == '\x1A') && is_padding(rest);
  }

  void read_line() {
    if (const auto line = marks_.with_points(text_)) {
      TextCursor row(*line, kStyle, text_.line());
      read_row(row);
    } else {
      read_row(text_);
    }
  }

  void read_row(TextCursor& row) {
    if (names_ && (names_->has_normals || !has_usual_order())) {
      read_named_row(row);
      return;
    }
    Vec3 point;
    for (double& coordinate : point) {
      coordinate = row.number("a coordinate");
    }
    const std::size_t more = widths_.check(row);
    if (normals_.possible() && may_guess_normals() && more == 3) {
      Vec3 normal;
      for (double& component : normal) {
        component = row.number("a component of a normal or of a colour");
      }
      object_.add_point(point, normal);
      normals_.look_at(normal);
    } else {
      object_.add_point(point);
      normals_.rule_out();
    }
    if (!normals_.possible()) {
      object_.forget_normals();
    }
  }

  bool has_usual_order() const { return names_->places[0] == 0 && names_->places[1] == 1 && names_->places[2] == 2; }
  // Names of three columns say nothing of those behind them.
  bool may_guess_normals() const { return !names_ || names_->columns == 3; }

  void read_named_row(TextCursor& row) {
    constexpr std::array kWhat = {"a coordinate", "a component of a normal"};
    const std::size_t wanted = names_->has_normals ? 6 : 3;
    std::array<double, 6> values{};
    std::size_t column = 0;
    for (; row.word_on_line(); ++column) {
      const auto last = names_->places.begin() + static_cast<std::ptrdiff_t>(wanted);
      const auto place =
          static_cast<std::size_t>(std::find(names_->places.begin(), last, column) - names_->places.begin());
      if (place < wanted) {
        values[place] = row.number(kWhat[place / 3]);
      } else {
        row.word();
      }
    }
    if (column != names_->columns) {
      row.fail(fmt::format("{} values, but line {} names {} columns", column, names_->line, names_->columns));
    }
    const Vec3 point(values[0], values[1], values[2]);
    wanted == 6 ? object_.add_point(point, {values[3], values[4], values[5]}) : object_.add_point(point);
  }

  TextCursor text_;
  ObjectBuilder object_;
  UnitNormals normals_;
  DecimalMarks marks_;
  RowWidths widths_;
  std::optional<ColumnNames> names_;
  std::optional<std::uint64_t> announced_;  // points of this scan
  std::size_t count_line_ = 0;
  std::uint64_t rows_ = 0;  // of this scan
};

Object read_xyz(const FileContent& file, const ReadLimits& limits) {
  return XyzReader(file.bytes, limits).read();
}

}  // namespace

ObjectFormat xyz_format() {
  return {.extensions = {".xyz", ".xyzn", ".pts", ".asc"},
          .ambiguous_extensions = {".txt"},
          .read = read_xyz,
          .likeness = likeness_of_xyz};
}

}  // namespace spincat::io
