// Object File Format, as Geomview defines it and as the world writes it.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "spincat/geometry/object.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

struct Header {
  bool normals = false;  // a normal follows the three coordinates of each vertex
};

// [ST][C][N][4][n]OFF, which may be glued to the counts or missing altogether.
Header read_header(TextCursor& text) {
  Header header;
  if (!text.word_follows()) {
    text.fail("expected the header 'OFF', but the file ends here");
  }
  const std::string_view word = text.peek();
  std::size_t at = 0;
  const auto take = [&](std::string_view letters) {
    const bool found = word.substr(at).starts_with(letters);
    if (found) {
      at += letters.size();
    }
    return found;
  };
  take("ST");
  take("C");
  header.normals = take("N");
  const bool four = take("4");
  const bool any_dimension = take("n");
  if (!same_word(word.substr(at, 3), "OFF")) {
    if (word[0] < '0' || word[0] > '9') {
      text.fail("expected the header 'OFF', found " + in_quotes(word));
    }
    return {};
  }
  if (four || any_dimension) {
    text.fail(
        fmt::format("is a {} file, whose vertices do not have three coordinates; spincat reads only those that do",
                    word.substr(0, at + 3)));
  }
  text.take(at + 3);
  if (text.peek() == "BINARY") {
    text.fail("is a binary OFF file; spincat reads only the text form");
  }
  return header;
}

void read_vertex(TextCursor& text, bool with_normal, ObjectBuilder& object) {
  Vec3 vertex;
  for (double& coordinate : vertex) {
    text.word_follows();
    coordinate = text.finite_number("a coordinate");
  }
  object.add_vertex(vertex);
  if (with_normal) {
    Vec3 normal;
    for (double& component : normal) {
      component = text.number("a component of a normal");
    }
    object.add_normal(normal);
  }
  text.skip_line();  // a colour, a place in a texture
}

void read_face(TextCursor& text, std::uint64_t vertices, ObjectBuilder& object) {
  text.word_follows();
  const std::uint64_t corners = text.count("a number of corners");
  object.begin_face();
  for (std::uint64_t i = 0; i < corners; ++i) {
    text.word_follows();
    const std::int64_t index = text.integer("a vertex index");
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices) {
      text.fail(out_of_range(index, vertices));
    }
    object.add_corner(static_cast<std::uint32_t>(index));
  }
  text.skip_line();  // a colour
}

// Throws unless `count` lines of at least `bytes` each fit into what is left; the last may lack its line end.
void check_fits(const TextCursor& text, std::uint64_t count, const char* what, std::uint64_t bytes) {
  if (count > (text.bytes_left() + 1) / bytes) {
    text.fail(fmt::format("announces {} {}, more than fit into the rest of the file", count, what));
  }
}

Object read_off(const FileContent& file, const ReadLimits& limits) {
  TextCursor text(file.bytes);
  ObjectBuilder object(limits);
  const Header header = read_header(text);
  text.word_follows();
  const std::uint64_t vertices = text.count("the number of vertices");
  text.word_follows();
  const std::uint64_t faces = text.count("the number of faces");
  check_fits(text, vertices, "vertices", 6);  // "0 0 0\n"
  check_fits(text, faces, "faces", 2);        // "0\n"
  object.expect_vertices(vertices);
  if (faces <= text.bytes_left() / 8) {
    object.reserve_triangles(faces);  // "3 0 0 0\n": most are triangles
  }
  text.skip_line();  // the number of edges, which nobody needs and many leave out

  for (std::uint64_t i = 0; i < vertices; ++i) {
    read_vertex(text, header.normals && faces == 0, object);
  }
  for (std::uint64_t i = 0; i < faces; ++i) {
    read_face(text, vertices, object);
  }
  return object.finish();
}

}  // namespace

ObjectFormat off_format() {
  return {.extensions = {".off"}, .read = read_off};
}

}  // namespace spincat::io
