// Stereolithography: triangles that repeat their vertices, as text or as bytes.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/rows.h"
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

// The header of a binary file may begin with "solid" as well: its size settles it, then what no text has.
bool is_text(std::string_view bytes) {
  TextCursor text(bytes, {.hash_comments = false});
  text.word_follows();
  if (!same_word(text.word(), "solid")) {
    return false;
  }
  constexpr std::size_t kLooked = 512;
  return bytes.size() < kHeaderSize ||
         (bytes.size() != binary_size(bytes) && bytes.substr(0, kLooked).find('\0') == std::string_view::npos);
}

class TextStlReader {
 public:
  TextStlReader(std::string_view bytes, const ReadLimits& limits)
      : text_(bytes, {.hash_comments = false}), object_(limits) {}

  Object read() {
    bool in_solid = false;
    bool in_notes = false;  // lines between "solid" and the first facet are for people
    for (; text_.word_follows(); text_.skip_line()) {
      const std::string_view word = text_.word();
      if (same_word(word, "solid")) {
        in_solid = in_notes = true;
      } else if (is_end_of("solid", word)) {
        in_solid = in_notes = false;
      } else if (same_word(word, "facet")) {
        in_notes = false;
      } else if (same_word(word, "outer")) {
        read_loop();
      } else if (!is_end_of("facet", word) && !in_notes) {
        if (is_padding(word) && is_padding(text_.rest())) {
          break;
        }
        text_.fail("expected 'facet', 'outer loop' or 'endsolid', found " + in_quotes(word));
      }
    }
    if (in_solid) {
      text_.fail("the file ends before 'endsolid'");
    }
    return object_.finish();
  }

 private:
  // "endloop" or "end loop"; takes the second word.
  bool is_end_of(std::string_view part, std::string_view word) {
    if (word.size() == 3 && same_word(word, "end") && same_word(text_.peek(), part)) {
      text_.word();
      return true;
    }
    return same_word(word.substr(0, 3), "end") && same_word(word.substr(std::min<std::size_t>(3, word.size())), part);
  }

  // From behind "outer" to "endloop".
  void read_loop() {
    constexpr int kCorners = 3;
    int corners = 0;
    text_.skip_line();
    object_.begin_face();
    for (; text_.word_follows(); ++corners) {
      const std::string_view word = text_.word();
      const bool is_end = is_end_of("loop", word);
      if (!is_end && !same_word(word, "vertex")) {
        text_.fail("expected 'vertex' or 'endloop', found " + in_quotes(word));
      }
      if (is_end != (corners == kCorners)) {
        text_.fail(
            fmt::format("{} {} corners in a facet, expected {}", is_end ? "only" : "more than", corners, kCorners));
      }
      if (is_end) {
        return;
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

// As many as the header announces, which is to be all. Some programs leave a count of 0 in the header, to be filled in
// later.
std::uint64_t triangles_in(std::string_view bytes) {
  const std::uint64_t announced = load<std::uint32_t>(bytes.data() + kHeaderSize - 4);
  const std::uint64_t follow = (bytes.size() - kHeaderSize) / kTriangleSize;
  if (announced > follow) {
    throw InputError(
        fmt::format("is cut off: {} triangles need {} bytes, it has {}", announced, binary_size(bytes), bytes.size()));
  }
  if (announced == 0 && bytes.size() == kHeaderSize + kTriangleSize * follow) {
    return follow;
  }
  expect_end(bytes.substr(binary_size(bytes)), kTriangleSize,
             fmt::format("the {} triangles that it announces", announced));
  return announced;
}

Object read_binary(std::string_view bytes, const ReadLimits& limits) {
  if (bytes.size() < kHeaderSize) {
    throw InputError(fmt::format("is cut off: the header alone needs {} bytes, it has {}", kHeaderSize, bytes.size()));
  }
  const std::uint64_t triangles = triangles_in(bytes);
  ObjectBuilder object(limits);
  VertexMerger merger;
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
  return {.extensions = {".stl"}, .read = read_stl, .likeness = likeness_of_stl};
}

}  // namespace spincat::io
