// Columns of numbers, a point a line: x y z, and maybe a normal, a colour or an intensity.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "spincat/geometry/object.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

std::size_t words_on_line(TextCursor text) {
  std::size_t words = 0;
  while (!text.word().empty()) {
    ++words;
  }
  return words;
}

// Three columns after x y z are a normal or a colour, and only the numbers tell: in a file of normals each has unit
// length, or is zero or nan where it is not known.
class NormalColumns {
 public:
  bool possible() const { return possible_; }
  bool found() const { return possible_ && seen_; }
  void rule_out() { possible_ = false; }
  void look_at(const Vec3& vector) {
    constexpr double kTolerance = 1e-2;
    const double length = vector.norm();
    if (std::abs(length - 1) <= kTolerance) {
      seen_ = true;
    } else if (std::isfinite(length) && length != 0) {
      possible_ = false;
    }
  }

 private:
  bool possible_ = true;
  bool seen_ = false;
};

class XyzReader {
 public:
  XyzReader(std::string_view bytes, const ReadLimits& limits)
      : text_(bytes, {.slash_comments = true, .commas_separate = true}), object_(limits) {}

  Object read() {
    read_announced_count();
    for (; text_.word_follows(); text_.skip_line(), ++rows_) {
      read_row();
    }
    if (announced_ && *announced_ > rows_) {
      text_.fail(fmt::format("the file ends after {} of {} points", rows_, *announced_));
    }
    if (!normals_.found()) {
      object_.forget_normals();
    }
    return object_.finish();
  }

 private:
  // A first line that is a lone number says how many points follow (.pts).
  void read_announced_count() {
    if (!text_.word_follows() || words_on_line(text_) != 1) {
      return;
    }
    announced_ = text_.count("the number of points or three coordinates");
    text_.skip_line();
  }

  void read_row() {
    Vec3 point;
    for (double& coordinate : point) {
      coordinate = text_.number("a coordinate");
    }
    if (normals_.possible() && words_on_line(text_) == 3) {
      Vec3 normal;
      for (double& component : normal) {
        component = text_.number("a component of a normal or of a colour");
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

  TextCursor text_;
  ObjectBuilder object_;
  NormalColumns normals_;
  std::optional<std::uint64_t> announced_;
  std::uint64_t rows_ = 0;
};

Object read_xyz(const FileContent& file, const ReadLimits& limits) {
  return XyzReader(file.bytes, limits).read();
}

}  // namespace

ObjectFormat xyz_format() {
  return {.extensions = {".xyz", ".xyzn", ".pts", ".asc"}, .ambiguous_extensions = {".txt"}, .read = read_xyz};
}

}  // namespace spincat::io
