// Polygon File Format: a header that describes elements and their properties, then their values as text or as bytes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/ply_header.h"
#include "spincat/io/formats/rows.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using ply::Element;
using ply::Encoding;
using ply::Header;
using ply::Property;

constexpr const char* kAnnounced = "the rows that the header announces";

// Where values come from: both kinds of body have next(), skip(), bytes_left(), least_size(), begin_element(),
// begin_row(), end_row(), finish(), line() and fail().
//
// In a text each row has a line, unless there are fewer lines than rows: then any blank parts numbers.
class TextBody {
 public:
  // `rows`: of all elements.
  TextBody(TextCursor text, std::uint64_t rows) : text_(text), has_lines_(lines_with_words(text, rows) == rows) {}

  double next(ScalarType) {
    text_.word_follows();
    return text_.number("a number");
  }
  void skip(std::uint64_t count, ScalarType type) {
    for (std::uint64_t i = 0; i < count; ++i) {
      next(type);
    }
  }
  std::uint64_t bytes_left() const { return text_.bytes_left() + 1; }  // the last line end may be missing
  static std::uint64_t least_size(ScalarType) { return 2; }            // a digit and a blank
  void begin_element() { ends_ = {}; }
  void begin_row(const Element&, std::uint64_t) {}
  void end_row() {
    if (has_lines_) {
      ends_.check(text_);
      text_.skip_line();
    }
  }
  void finish(std::uint64_t) { expect_end(text_, kAnnounced); }
  std::size_t line() const { return text_.line(); }
  [[noreturn]] void fail(const std::string& problem) const { text_.fail(problem); }

 private:
  TextCursor text_;
  bool has_lines_;
  RowEnds ends_;
};

class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, std::endian order) : bytes_(bytes), order_(order) {}

  double next(ScalarType type) {
    const char* at = bytes_.data();
    skip(1, type);
    return load_scalar(at, type, order_);
  }
  void skip(std::uint64_t count, ScalarType type) {
    if (count > bytes_.size() / size_of(type)) {
      fail("the file ends here");
    }
    bytes_.remove_prefix(count * size_of(type));
  }
  std::uint64_t bytes_left() const { return bytes_.size(); }
  static std::uint64_t least_size(ScalarType type) { return size_of(type); }
  void begin_element() {}
  void begin_row(const Element& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
  }
  void end_row() {}
  void finish(std::uint64_t row) { expect_end(bytes_, row, kAnnounced); }
  std::size_t line() const { return 0; }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{} {}: {}", shown(element_->name), row_, problem));
  }

 private:
  std::string_view bytes_;
  std::endian order_;
  const Element* element_ = nullptr;
  std::uint64_t row_ = 0;
};

bool is_corner_list(const Property& property) {
  return property.length_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// The six properties of a vertex that matter: x, y, z, nx, ny, nz.
class VertexColumns {
 public:
  explicit VertexColumns(const Element& element) {
    static constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
    std::array<bool, 6> found{};
    for (const Property& property : element.properties) {
      const auto* name =
          std::ranges::find_if(kNames, [&](std::string_view known) { return same_word(known, property.name); });
      const auto column = static_cast<std::size_t>(name - kNames.begin());
      const bool wanted = column < kNames.size() && !property.length_type && !found[column];
      if (wanted) {
        found[column] = true;
      }
      columns_.push_back(wanted ? column : kUnused);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (!found[i]) {
        throw InputError(fmt::format("its vertices have no property '{}'", kNames[i]));
      }
    }
    has_normals_ = found[3] && found[4] && found[5];
  }

  // Where the value of a property belongs; a place that nobody reads for the others.
  std::size_t column(std::size_t property) const { return columns_[property]; }
  bool has_normals() const { return has_normals_; }

  static constexpr std::size_t kUnused = 6;

 private:
  std::vector<std::size_t> columns_;
  bool has_normals_ = false;
};

template <typename Body>
class PlyReader {
 public:
  PlyReader(const Header& header, Body body, const ReadLimits& limits)
      : header_(header), body_(std::move(body)), object_(limits) {}

  Object read() {
    const Element* vertex = header_.find("vertex");
    const Element* face = header_.find("face");
    if (vertex != nullptr) {
      vertices_ = vertex->count;
    }
    object_.check_vertices(vertices_);
    if (vertices_ > 0) {
      check_properties(*vertex);
    }
    is_mesh_ = has_corners(face) || has_corners(header_.find("tristrips"));
    for (const Element& element : header_.elements) {
      read_element(element);
    }
    body_.finish(least_row_);
    return object_.finish();
  }

 private:
  // Rows without properties take no bytes and are passed over: vertices that are never read must not be counted on.
  static void check_properties(const Element& vertex) { static_cast<void>(VertexColumns(vertex)); }

  static bool has_corners(const Element* element) {
    return element != nullptr && element->count > 0 &&
           std::any_of(element->properties.begin(), element->properties.end(), is_corner_list);
  }

  // A list as a polygon of three corners, for what follows the last row.
  static std::uint64_t usual_size(const Property& property) {
    constexpr std::uint64_t kCorners = 3;
    return property.length_type ? Body::least_size(*property.length_type) + kCorners * Body::least_size(property.type)
                                : Body::least_size(property.type);
  }

  void read_element(const Element& element) {
    if (element.properties.empty()) {
      return;
    }
    body_.begin_element();
    body_.begin_row(element, 0);
    std::uint64_t least_row = 0;
    least_row_ = 0;
    for (const Property& property : element.properties) {
      least_row += Body::least_size(property.length_type.value_or(property.type));
      least_row_ += usual_size(property);
    }
    if (element.count > body_.bytes_left() / least_row) {  // NOLINT(clang-analyzer-core.DivideZero): each has a size
      body_.fail(fmt::format("announces {} x {}, more than fit into the rest of the file", element.count,
                             shown(element.name)));
    }
    if (element.name == "vertex") {
      read_vertices(element);
    } else if (element.name == "face" || element.name == "tristrips") {
      read_faces(element);
    } else {
      skip_rows(element);
    }
  }

  void read_vertices(const Element& element) {
    const VertexColumns columns(element);
    object_.expect_vertices(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      body_.begin_row(element, row);
      std::array<double, VertexColumns::kUnused + 1> values{};
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const Property& property = element.properties[i];
        if (property.length_type) {
          skip_list(property);
        } else {
          values[columns.column(i)] = body_.next(property.type);
        }
      }
      add_vertex({values[0], values[1], values[2]}, {values[3], values[4], values[5]}, columns.has_normals());
      body_.end_row();
    }
  }

  void add_vertex(const Vec3& position, const Vec3& normal, bool has_normal) {
    if (is_mesh_) {
      object_.add_vertex(position, body_.line());
    } else if (has_normal) {
      object_.add_point(position, normal);
    } else {
      object_.add_point(position);
    }
  }

  void read_faces(const Element& element) {
    reserve_triangles(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      body_.begin_row(element, row);
      for (const Property& property : element.properties) {
        if (is_corner_list(property)) {
          element.name == "face" ? read_face(property) : read_strip(property);
        } else {
          skip_property(property);
        }
      }
      body_.end_row();
    }
  }

  // Indices of one byte make many triangles of few bytes: growing by doubling would cost 36 times the file.
  void reserve_triangles(const Element& element) {
    const bool tiny = std::any_of(element.properties.begin(), element.properties.end(), [](const Property& property) {
      return is_corner_list(property) && Body::least_size(property.type) == 1;
    });
    object_.reserve_triangles(tiny ? body_.bytes_left() : element.count);
  }

  void read_face(const Property& property) {
    const std::uint64_t corners = list_length(property);
    object_.begin_face();
    for (std::uint64_t i = 0; i < corners; ++i) {
      object_.add_corner(vertex_index(body_.next(property.type)));
    }
  }

  // Strips of triangles in one list; -1 ends each but the last. Unsigned numbers write it as the largest there is.
  void read_strip(const Property& property) {
    constexpr double kLargest = std::numeric_limits<std::uint32_t>::max();
    const std::uint64_t corners = list_length(property);
    object_.begin_strip();
    for (std::uint64_t i = 0; i < corners; ++i) {
      const double index = body_.next(property.type);
      if (index == -1 || index == kLargest) {
        object_.begin_strip();
      } else {
        object_.add_strip_corner(vertex_index(index));
      }
    }
  }

  std::uint32_t vertex_index(double index) const {
    if (!(index >= 0 && index < static_cast<double>(vertices_)) || index != std::floor(index)) {
      body_.fail(fmt::format("vertex index {} is out of range ({} vertices)", index, vertices_));
    }
    return static_cast<std::uint32_t>(index);
  }

  std::uint64_t list_length(const Property& property) {
    const double length = body_.next(*property.length_type);
    const std::uint64_t most = body_.bytes_left() / Body::least_size(property.type);
    if (!(length >= 0 && length <= static_cast<double>(most)) || length != std::floor(length)) {
      body_.fail(fmt::format("a list of {} values does not fit into the rest of the file", length));
    }
    return static_cast<std::uint64_t>(length);
  }

  void skip_list(const Property& property) { body_.skip(list_length(property), property.type); }

  void skip_property(const Property& property) {
    if (property.length_type) {
      skip_list(property);
    } else {
      body_.skip(1, property.type);
    }
  }

  void skip_rows(const Element& element) {
    for (std::uint64_t row = 0; row < element.count; ++row) {
      body_.begin_row(element, row);
      for (const Property& property : element.properties) {
        skip_property(property);
      }
      body_.end_row();
    }
  }

  const Header& header_;
  Body body_;
  ObjectBuilder object_;
  std::uint64_t vertices_ = 0;
  std::uint64_t least_row_ = 0;  // bytes of a row of the last element
  bool is_mesh_ = false;
};

std::uint64_t rows_of(const Header& header) {
  std::uint64_t rows = 0;
  for (const Element& element : header.elements) {
    rows += element.properties.empty() ? 0 : element.count;
  }
  return rows;
}

Object read_ply(const FileContent& file, const ReadLimits& limits) {
  TextCursor text(file.bytes, {.hash_comments = false});
  const Header header = ply::read_header(text);
  if (header.encoding == Encoding::ascii) {
    return PlyReader(header, TextBody(text, rows_of(header)), limits).read();
  }
  const std::string_view body = file.bytes.substr(file.bytes.size() - text.bytes_left());
  const std::endian order = header.encoding == Encoding::little_endian ? std::endian::little : std::endian::big;
  return PlyReader(header, BinaryBody(body, order), limits).read();
}

}  // namespace

ObjectFormat ply_format() {
  return {.extensions = {".ply"}, .read = read_ply, .likeness = likeness_of_ply};
}

}  // namespace spincat::io
