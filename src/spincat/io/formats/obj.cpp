// Wavefront OBJ: vertices and polygons; groups, materials and curves are passed over.
#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const ReadLimits& limits)
      : text_(bytes, {.backslash_continues = true}), object_(limits) {}

  Object read() {
    while (text_.word_follows()) {
      const std::string_view keyword = text_.word();
      if (keyword == "v") {
        const Vec3 position = read_position();
        object_.add_vertex(position, text_.line());
      } else if (keyword == "vn") {
        object_.add_normal(read_normal());
      } else if (keyword == "f") {
        read_face();
      }
      text_.skip_line();  // of a vertex: its weight or colour
    }
    if (highest_index_ > 0 && static_cast<std::uint64_t>(highest_index_) > object_.vertices()) {
      throw InputError(
          fmt::format("line {}: {}", highest_index_line_, out_of_range(highest_index_, object_.vertices())));
    }
    return object_.finish();
  }

 private:
  Vec3 read_position() {
    Vec3 position;
    for (double& coordinate : position) {
      coordinate = text_.number("a coordinate");
    }
    return position;
  }

  Vec3 read_normal() {
    Vec3 normal;
    for (double& component : normal) {
      component = text_.number("a component of a normal");
    }
    return normal;
  }

  void read_face() {
    object_.begin_face();
    std::size_t corners = 0;
    std::string_view first;
    std::string_view last;
    for (; text_.word_on_line(); ++corners) {
      last = text_.peek();
      first = corners == 0 ? last : first;
      object_.add_corner(read_corner());
    }
    if (text_.bytes_left() == 0 && (corners < 3 || form_of(last) != form_of(first))) {
      text_.fail("the file ends within a face");
    }
  }

  // 7/1/3 has other parts than 7/ or 7//3: a bit for each slash and each number behind one.
  static unsigned form_of(std::string_view corner) {
    unsigned form = 1;
    for (std::size_t at = corner.find('/'); at != std::string_view::npos; at = corner.find('/', at + 1)) {
      const bool is_filled = at + 1 < corner.size() && corner[at + 1] != '/';
      form = 2 * form + (is_filled ? 1 : 0);
    }
    return form;
  }

  // The vertex of a corner like 7, 7/1, 7//3, 7/1/3 or -1, which is the newest vertex.
  std::uint32_t read_corner() {
    const std::string_view word = text_.word();
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    std::int64_t index = 0;
    const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const bool whole = last == digits.data() + digits.size();
    if (error != std::errc() || !(whole || *last == '/')) {
      text_.fail("expected a vertex index, found " + in_quotes(word));
    }
    const auto vertices = static_cast<std::int64_t>(object_.vertices());
    if (index == 0 || index < -vertices || index > kMostIndex) {
      text_.fail(out_of_range(index, object_.vertices()));
    }
    if (index < 0) {
      return static_cast<std::uint32_t>(vertices + index);
    }
    // A face may stand before its vertices: whether they come shows at the end.
    if (index > highest_index_) {
      highest_index_ = index;
      highest_index_line_ = text_.line();
    }
    return static_cast<std::uint32_t>(index - 1);
  }

  static constexpr std::int64_t kMostIndex = 0xFFFF'FFFF;

  TextCursor text_;
  ObjectBuilder object_;
  std::int64_t highest_index_ = 0;
  std::size_t highest_index_line_ = 0;
};

Object read_obj(const FileContent& file, const ReadLimits& limits) {
  return ObjReader(file.bytes, limits).read();
}

}  // namespace

ObjectFormat obj_format() {
  return {.extensions = {".obj"}, .read = read_obj, .likeness = likeness_of_obj};
}

}  // namespace spincat::io
