// Point Cloud Data, the format of the Point Cloud Library: a header of text, then points as text, as bytes or as
// compressed bytes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/formats/lzf.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/rows.h"
#include "spincat/io/organized_cloud.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

struct Field {
  std::string name;
  std::uint64_t size = 4;   // bytes of one value
  char type = 'F';          // F, I or U
  std::uint64_t count = 1;  // values of this field in a point
};

struct Header {
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::uint64_t width = 0;   // of the picture that the points make up; 0 where the file does not say
  std::uint64_t height = 1;  // 1: they make up none
  std::optional<Vec3> sensor;
  std::string encoding;  // what follows DATA: ascii, binary or binary_compressed

  std::uint64_t values_per_point() const {
    std::uint64_t sum = 0;
    for (const Field& field : fields) {
      sum += field.count;
    }
    return sum;
  }
  std::uint64_t point_size() const {
    std::uint64_t sum = 0;
    for (const Field& field : fields) {
      sum += field.count * field.size;
    }
    return sum;
  }
};

class HeaderReader {
 public:
  explicit HeaderReader(TextCursor& text) : text_(text) {}

  // Leaves the cursor behind the line DATA.
  Header read() {
    for (; text_.word_follows(); text_.skip_line()) {
      const std::string_view keyword = text_.word();
      if (same_word(keyword, "DATA")) {
        return finish();
      }
      read_line(keyword);
    }
    text_.fail("the file ends within the header, before 'DATA'");
  }

 private:
  void read_line(std::string_view keyword) {
    if (same_word(keyword, "FIELDS") || same_word(keyword, "COLUMNS")) {
      while (text_.word_on_line()) {
        add_field(text_.word());
      }
    } else if (same_word(keyword, "SIZE")) {
      for (Field& field : header_.fields) {
        field.size = read_size();
      }
    } else if (same_word(keyword, "TYPE")) {
      for (Field& field : header_.fields) {
        field.type = read_type();
      }
    } else if (same_word(keyword, "COUNT")) {
      for (Field& field : header_.fields) {
        field.count = read_count();
      }
    } else if (same_word(keyword, "WIDTH")) {
      width_ = text_.count("the width");
    } else if (same_word(keyword, "HEIGHT")) {
      height_ = text_.count("the height");
    } else if (same_word(keyword, "POINTS")) {
      points_ = text_.count("the number of points");
    } else if (same_word(keyword, "VIEWPOINT")) {
      header_.sensor = read_viewpoint();
    } else if (!same_word(keyword, "VERSION")) {
      text_.fail("unknown word " + in_quotes(keyword) + " in the header");
    }
  }

  void add_field(std::string_view name) {
    constexpr std::size_t kMost = 1'000;  // a field takes far more memory than its name
    if (header_.fields.size() == kMost) {
      text_.fail(fmt::format("more than {} fields", kMost));
    }
    header_.fields.emplace_back().name = name;
  }

  std::uint64_t read_size() {
    const std::uint64_t size = text_.count("the size of a field");
    if (size != 1 && size != 2 && size != 4 && size != 8) {
      text_.fail(fmt::format("a field's size must be 1, 2, 4 or 8, found {}", size));
    }
    return size;
  }

  char read_type() {
    const std::string_view type = text_.word();
    for (const char known : {'F', 'I', 'U'}) {
      if (same_word(type, {&known, 1})) {
        return known;
      }
    }
    text_.fail("a field's type must be F, I or U, found " + in_quotes(type));
  }

  std::uint64_t read_count() {
    constexpr std::uint64_t kMost = 0xFFFF'FFFF;
    const std::uint64_t count = text_.count("the count of a field");
    if (count > kMost) {
      text_.fail(fmt::format("a field's count must be at most {}, found {}", kMost, count));
    }
    return count;
  }

  // The place of the sensor: a translation and a rotation (w x y z), of which normals need only the first.
  std::optional<Vec3> read_viewpoint() {
    std::array<double, 7> pose{};
    for (double& number : pose) {
      number = text_.finite_number("a number of the viewpoint");
    }
    constexpr std::array<double, 7> kUnknown{0, 0, 0, 1, 0, 0, 0};  // what programs write when they do not know
    if (pose == kUnknown) {
      return std::nullopt;
    }
    return Vec3(pose[0], pose[1], pose[2]);
  }

  Header finish() {
    header_.encoding = text_.word();
    if (header_.fields.empty()) {
      text_.fail("the header has no line 'FIELDS'");
    }
    std::erase_if(header_.fields, [](const Field& field) { return field.count == 0; });  // fields without values
    if (header_.fields.empty()) {
      text_.fail("the count of each field is 0");
    }
    if (!points_ && !width_) {
      text_.fail("the header says neither 'POINTS' nor 'WIDTH'");
    }
    if (width_) {
      if (*width_ > kLongestSide || height_.value_or(1) > kLongestSide) {
        text_.fail("WIDTH x HEIGHT is too large");
      }
      const std::uint64_t area = *width_ * height_.value_or(1);
      if (points_ && area != *points_) {
        text_.fail(fmt::format("WIDTH {} x HEIGHT {} is not POINTS {}", *width_, height_.value_or(1), *points_));
      }
      points_ = area;
    }
    static constexpr std::array<std::string_view, 3> kEncodings = {"ascii", "binary", "binary_compressed"};
    const auto* const encoding =
        std::ranges::find_if(kEncodings, [&](std::string_view known) { return same_word(known, header_.encoding); });
    if (encoding == kEncodings.end()) {
      text_.fail("unknown data format " + in_quotes(header_.encoding) +
                 "; expected ascii, binary or binary_compressed");
    }
    header_.encoding = *encoding;
    header_.points = *points_;
    header_.width = width_.value_or(0);
    header_.height = height_.value_or(1);
    text_.skip_line();
    return header_;
  }

  static constexpr std::uint64_t kLongestSide = 0xFFFF'FFFF;  // whose square is still a number

  TextCursor& text_;
  Header header_;
  std::optional<std::uint64_t> width_, height_, points_;
};

ScalarType scalar_type(const Field& field) {
  if (field.type == 'F') {
    if (field.size == 4) {
      return ScalarType::float32;
    }
    if (field.size == 8) {
      return ScalarType::float64;
    }
    throw InputError(fmt::format("field {}: no floating-point number has {} bytes", in_quotes(field.name), field.size));
  }
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? ScalarType::int8 : ScalarType::uint8;
    case 2:
      return is_signed ? ScalarType::int16 : ScalarType::uint16;
    case 4:
      return is_signed ? ScalarType::int32 : ScalarType::uint32;
    default:
      return is_signed ? ScalarType::int64 : ScalarType::uint64;
  }
}

// x, y, z and the normal, as indices of fields; the normal may be missing.
struct WantedFields {
  std::array<std::size_t, 6> index{};
  std::size_t number = 3;  // 3 or 6
};

WantedFields find_fields(const Header& header) {
  static constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "normal_x", "normal_y", "normal_z"};
  WantedFields wanted;
  std::size_t found = 0;
  for (; found < kNames.size(); ++found) {
    auto field = std::ranges::find(header.fields, kNames[found], &Field::name);
    if (field == header.fields.end()) {
      field = std::ranges::find_if(header.fields, [&](const Field& f) { return same_word(f.name, kNames[found]); });
    }
    if (field == header.fields.end()) {
      break;
    }
    wanted.index[found] = static_cast<std::size_t>(field - header.fields.begin());
  }
  if (found < 3) {
    throw InputError(fmt::format("its points have no field '{}'", kNames[found]));
  }
  wanted.number = found == kNames.size() ? 6 : 3;
  return wanted;
}

// What becomes of the points of a file.
class PointSink {
 public:
  virtual ~PointSink() = default;
  virtual void expect(std::uint64_t points) = 0;  // called once the file is known to be long enough
  virtual void add(const Vec3& point, const Vec3* normal) = 0;
};

class ObjectSink : public PointSink {
 public:
  explicit ObjectSink(ObjectBuilder& object) : object_(object) {}
  void expect(std::uint64_t points) override { object_.expect_vertices(points); }
  void add(const Vec3& point, const Vec3* normal) override {
    normal != nullptr ? object_.add_point(point, *normal) : object_.add_point(point);
  }

 private:
  ObjectBuilder& object_;
};

class PictureSink : public PointSink {
 public:
  explicit PictureSink(std::vector<Vec3>& points) : points_(points) {}
  void expect(std::uint64_t points) override { points_.reserve(points); }
  void add(const Vec3& point, const Vec3*) override { points_.push_back(point); }

 private:
  std::vector<Vec3>& points_;
};

void add_point(const std::array<double, 6>& values, std::size_t number, PointSink& sink) {
  const Vec3 normal(values[3], values[4], values[5]);
  sink.add(Vec3(values[0], values[1], values[2]), number == 6 ? &normal : nullptr);
}

std::string announced(const Header& header) {
  return fmt::format("the {} points that it announces", header.points);
}

[[noreturn]] void fail_cut_off(const Header& header, std::size_t bytes_left) {
  throw InputError(
      fmt::format("announces {} points, more than fit into the {} bytes that follow", header.points, bytes_left));
}

void read_text(const Header& header, TextCursor& text, PointSink& sink) {
  const WantedFields wanted = find_fields(header);
  if (header.points > (text.bytes_left() + 1) / (2 * header.values_per_point())) {
    fail_cut_off(header, text.bytes_left());
  }
  sink.expect(header.points);
  RowEnds ends;
  for (std::uint64_t i = 0; i < header.points; ++i, text.skip_line()) {
    if (!text.word_follows()) {
      text.fail(fmt::format("the file ends after {} of {} points", i, header.points));
    }
    std::array<double, 6> values{};
    for (std::size_t f = 0; f < header.fields.size(); ++f) {
      const auto* last = wanted.index.begin() + wanted.number;
      const auto* place = std::find(wanted.index.begin(), last, f);
      for (std::uint64_t k = 0; k < header.fields[f].count; ++k) {
        const double value = text.number("a number");
        if (k == 0 && place != last) {
          values[static_cast<std::size_t>(place - wanted.index.begin())] = value;
        }
      }
    }
    ends.check(text);
    add_point(values, wanted.number, sink);
  }
  expect_end(text, announced(header));
}

// Where the values of a field lie: those of point i begin at offset + i * stride.
struct Column {
  ScalarType type;
  std::size_t offset;
  std::size_t stride;
};

// `bytes` holds header.points * header.point_size() bytes: point after point, or `by_field`, field after field.
void read_values(const Header& header, std::string_view bytes, bool by_field, PointSink& sink) {
  const WantedFields wanted = find_fields(header);
  std::array<Column, 6> columns{};
  for (std::size_t w = 0; w < wanted.number; ++w) {
    const Field& field = header.fields[wanted.index[w]];
    std::size_t offset = 0;
    for (std::size_t f = 0; f < wanted.index[w]; ++f) {
      offset += header.fields[f].size * header.fields[f].count;
    }
    columns[w] = by_field ? Column{scalar_type(field), offset * header.points, field.size * field.count}
                          : Column{scalar_type(field), offset, header.point_size()};
  }
  sink.expect(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    std::array<double, 6> values{};
    for (std::size_t w = 0; w < wanted.number; ++w) {
      values[w] = load_scalar(bytes.data() + columns[w].offset + i * columns[w].stride, columns[w].type);
    }
    add_point(values, wanted.number, sink);
  }
}

void read_compressed(const Header& header, std::string_view bytes, const ReadLimits& limits, PointSink& sink) {
  if (bytes.size() < 8) {
    fail_cut_off(header, bytes.size());
  }
  const std::size_t packed_size = load<std::uint32_t>(bytes.data());
  const std::size_t size = load<std::uint32_t>(bytes.data() + 4);
  bytes.remove_prefix(8);
  if (packed_size > bytes.size()) {
    fail_cut_off(header, bytes.size());
  }
  if (header.points > size / header.point_size() || header.points * header.point_size() != size) {
    throw InputError(fmt::format("its {} points of {} bytes do not make up the {} bytes that are compressed",
                                 header.points, header.point_size(), size));
  }
  constexpr std::size_t kBestRatio = 88;  // 264 bytes out of 3
  if (size / kBestRatio > packed_size) {
    throw InputError("its compressed points are damaged");
  }
  check_growth(size + header.points * 2 * sizeof(Vec3), bytes.size(), limits);
  read_values(header, unpack_lzf(bytes.substr(0, packed_size), size), true, sink);
}

// The points behind the header, in whatever form they come.
void read_points(const Header& header, TextCursor& text, std::string_view bytes, const ReadLimits& limits,
                 PointSink& sink) {
  const std::string_view body = bytes.substr(bytes.size() - text.bytes_left());
  if (header.encoding == "ascii") {
    read_text(header, text, sink);
  } else if (header.encoding == "binary") {
    if (header.points > body.size() / header.point_size()) {
      fail_cut_off(header, body.size());
    }
    expect_end(body.substr(header.points * header.point_size()), header.point_size(), announced(header));
    read_values(header, body, false, sink);
  } else {
    read_compressed(header, body, limits, sink);
  }
}

Object read_pcd(const FileContent& file, const ReadLimits& limits) {
  TextCursor text(file.bytes);
  const Header header = HeaderReader(text).read();
  ObjectBuilder object(limits);
  object.check_vertices(header.points);
  if (header.sensor) {
    object.set_sensor(*header.sensor);
  }
  ObjectSink sink(object);
  read_points(header, text, file.bytes, limits, sink);
  return object.finish();
}

}  // namespace

ObjectFormat pcd_format() {
  return {.extensions = {".pcd"}, .read = read_pcd, .likeness = likeness_of_pcd};
}

}  // namespace spincat::io

namespace spincat {

OrganizedCloud read_organized_pcd(std::string_view bytes, const ReadLimits& limits) {
  io::TextCursor text(bytes);
  const io::Header header = io::HeaderReader(text).read();
  constexpr std::uint64_t kLongestSide = 8'192;
  if (header.height < 2 || header.width < 2) {
    throw InputError("its points make up no picture (HEIGHT 2 or more was expected)");
  }
  if (header.width > kLongestSide || header.height > kLongestSide) {
    throw InputError(fmt::format("is {} x {} points large (at most {} x {})", header.width, header.height, kLongestSide,
                                 kLongestSide));
  }
  OrganizedCloud cloud{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  io::PictureSink sink(cloud.points);
  io::read_points(header, text, bytes, limits, sink);
  return cloud;
}

}  // namespace spincat
