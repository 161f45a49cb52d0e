// Stereolithography: triangles that repeat their vertices, as text or as bytes.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/vertex_merger.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

constexpr std::size_t kHeaderSize = 84;    // a free text of 80 bytes and the number of triangles
constexpr std::size_t kTriangleSize = 50;  // a normal and three corners as floats, two spare bytes

std::uint64_t binary_size(std::string_view bytes) {
  return kHeaderSize + kTriangleSize * std::uint64_t{load<std::uint32_t>(bytes.data() + kHeaderSize - 4)};
}

// The header of a binary file may begin with "solid" as well: its size settles it, then what follows the first line.
bool is_text(std::string_view bytes) {
  TextCursor text(bytes, {.hash_comments = false});
  text.word_follows();
  if (!same_word(text.word(), "solid")) {
    return false;
  }
  if (bytes.size() < kHeaderSize) {
    return true;
  }
  if (bytes.size() == binary_size(bytes)) {
    return false;
  }
  text.skip_line();
  text.word_follows();
  const std::string_view second = text.peek();
  return same_word(second, "facet") || same_word(second, "endsolid");
}

class TextStlReader {
 public:
  TextStlReader(std::string_view bytes, const ReadLimits& limits)
      : text_(bytes, {.hash_comments = false}), object_(limits) {}

  Object read() {
    bool in_solid = false;
    for (; text_.word_follows(); text_.skip_line()) {
      const std::string_view word = text_.word();
      if (same_word(word, "solid")) {
        in_solid = true;
      } else if (same_word(word, "endsolid")) {
        in_solid = false;
      } else if (same_word(word, "outer")) {
        read_loop();
      } else if (!same_word(word, "facet") && !same_word(word, "endfacet")) {
        text_.fail("expected 'facet', 'outer loop' or 'endsolid', found " + in_quotes(word));
      }
    }
    if (in_solid) {
      text_.fail("the file ends before 'endsolid'");
    }
    return object_.finish();
  }

 private:
  // From behind "outer" to "endloop".
  void read_loop() {
    text_.skip_line();
    object_.begin_face();
    while (text_.word_follows()) {
      const std::string_view word = text_.word();
      if (same_word(word, "endloop")) {
        return;
      }
      if (!same_word(word, "vertex")) {
        text_.fail("expected 'vertex' or 'endloop', found " + in_quotes(word));
      }
      Vec3 position;
      for (double& coordinate : position) {
        coordinate = text_.finite_number("a coordinate");
      }
      object_.add_corner(object_.add_merged_vertex(position, merger_));
    }
    text_.fail("the file ends within a facet");
  }

  TextCursor text_;
  ObjectBuilder object_;
  VertexMerger merger_;
};

Vec3 corner_at(const char* at, std::uint64_t triangle) {
  Vec3 corner(load<float>(at), load<float>(at + 4), load<float>(at + 8));
  if (!corner.allFinite()) {
    throw InputError(fmt::format("triangle {}: a coordinate is not finite", triangle));
  }
  return corner;
}

Object read_binary(std::string_view bytes, const ReadLimits& limits) {
  if (bytes.size() < kHeaderSize) {
    throw InputError(fmt::format("is cut off: the header alone needs {} bytes, it has {}", kHeaderSize, bytes.size()));
  }
  if (bytes.size() < binary_size(bytes)) {
    throw InputError(fmt::format("is cut off: {} triangles need {} bytes, it has {}",
                                 load<std::uint32_t>(bytes.data() + kHeaderSize - 4), binary_size(bytes),
                                 bytes.size()));
  }
  ObjectBuilder object(limits);
  VertexMerger merger;
  const std::uint64_t triangles = (binary_size(bytes) - kHeaderSize) / kTriangleSize;
  object.check_triangles(triangles);
  object.reserve_triangles(triangles);
  for (std::uint64_t i = 0; i < triangles; ++i) {
    const char* at = bytes.data() + kHeaderSize + i * kTriangleSize + 12;  // past the normal
    object.begin_face();
    for (int corner = 0; corner < 3; ++corner) {
      object.add_corner(object.add_merged_vertex(corner_at(at + corner * 12, i), merger));
    }
  }
  return object.finish();
}

Object read_stl(const FileContent& file, const ReadLimits& limits) {
  return is_text(file.bytes) ? TextStlReader(file.bytes, limits).read() : read_binary(file.bytes, limits);
}

}  // namespace

ObjectFormat stl_format() {
  return {.extensions = {".stl"}, .read = read_stl};
}

}  // namespace spincat::io
