// Object File Format, as Geomview defines it and as the world writes it.
#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/rows.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

struct Header {
  bool texture = false;  // two numbers behind each vertex
  bool colours = false;  // and four before them
  bool normals = false;  // and three before those: a normal
  bool binary = false;

  std::uint64_t numbers_of_vertex() const {
    return 3 + (normals ? 3U : 0U) + (colours ? 4U : 0U) + (texture ? 2U : 0U);
  }
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
  header.texture = take("ST");
  header.colours = take("C");
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
  header.binary = text.peek() == "BINARY";
  return header;
}

std::string announced(std::uint64_t vertices, std::uint64_t faces) {
  return fmt::format("the {} vertices and {} faces that it announces", vertices, faces);
}

// A vertex or a face has a line, with a colour and more at its end, unless there are fewer lines than that: then any
// blank parts numbers.
class TextOffReader {
 public:
  TextOffReader(TextCursor text, const Header& header, const ReadLimits& limits)
      : text_(text), header_(header), object_(limits) {}

  Object read() {
    read_counts();
    has_lines_ = lines_with_words(text_, vertices_ + faces_) == vertices_ + faces_;
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      read_vertex();
    }
    has_lines_ = has_lines_ || lines_with_words(text_, faces_) == faces_;
    for (std::uint64_t i = 0; i < faces_; ++i) {
      read_face();
    }
    expect_end(text_, announced(vertices_, faces_));
    return object_.finish();
  }

 private:
  void read_counts() {
    text_.word_follows();
    vertices_ = text_.count("the number of vertices");
    text_.word_follows();
    faces_ = text_.count("the number of faces");
    check_fits(vertices_, "vertices", 6);  // "0 0 0\n"
    check_fits(faces_, "faces", 2);        // "0\n"
    object_.expect_vertices(vertices_);
    if (faces_ <= text_.bytes_left() / 8) {
      object_.reserve_triangles(faces_);  // "3 0 0 0\n": most are triangles
    }
    text_.word();  // the number of edges, which nobody needs and many leave out
  }

  // Throws unless `count` lines of at least `bytes` each fit into what is left; the last may lack its line end.
  void check_fits(std::uint64_t count, const char* what, std::uint64_t bytes) const {
    if (count > (text_.bytes_left() + 1) / bytes) {
      text_.fail(fmt::format("announces {} {}, more than fit into the rest of the file", count, what));
    }
  }

  void read_vertex() {
    Vec3 vertex;
    for (double& coordinate : vertex) {
      text_.word_follows();
      coordinate = text_.number("a coordinate");
    }
    object_.add_vertex(vertex, text_.line());
    std::uint64_t numbers = 3;
    if (header_.normals && (faces_ == 0 || !has_lines_)) {
      Vec3 normal;
      for (double& component : normal) {
        component = number_on_line("a component of a normal");
      }
      numbers += 3;
      if (faces_ == 0) {
        object_.add_normal(normal);
      }
    }
    if (has_lines_) {
      if (!header_.colours && !header_.texture) {  // a colour may have three numbers or four
        ends_.check(text_);
      }
      text_.skip_line();
    }
    for (; !has_lines_ && numbers < header_.numbers_of_vertex(); ++numbers) {
      number_on_line("a number of a colour");
    }
  }

  double number_on_line(const char* what) {
    if (!has_lines_) {
      text_.word_follows();
    }
    return text_.number(what);
  }

  void read_face() {
    text_.word_follows();
    const std::uint64_t corners = text_.count("a number of corners");
    object_.begin_face();
    for (std::uint64_t i = 0; i < corners; ++i) {
      text_.word_follows();
      const std::int64_t index = text_.integer("a vertex index");
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_) {
        text_.fail(out_of_range(index, vertices_));
      }
      object_.add_corner(static_cast<std::uint32_t>(index));
    }
    if (has_lines_) {
      text_.skip_line();  // a colour
    }
  }

  TextCursor text_;
  Header header_;
  ObjectBuilder object_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
  bool has_lines_ = true;
  RowEnds ends_;
};

// Integers and floats of four bytes, the largest first.
class BinaryOffReader {
 public:
  BinaryOffReader(std::string_view bytes, const Header& header, const ReadLimits& limits)
      : bytes_(bytes), header_(header), object_(limits) {}

  Object read() {
    vertices_ = next_count("the number of vertices");
    faces_ = next_count("the number of faces");
    next_count("the number of edges");
    const std::uint64_t vertex = kSize * header_.numbers_of_vertex();
    check_fits(vertices_, vertex, "vertices");
    object_.expect_vertices(vertices_);
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      read_vertex(vertex);
    }
    check_fits(faces_, 2 * kSize, "faces");
    object_.reserve_triangles(faces_);
    for (std::uint64_t i = 0; i < faces_; ++i) {
      read_face(i);
    }
    constexpr std::uint64_t kTriangle = 5 * kSize;
    expect_end(bytes_, kTriangle, announced(vertices_, faces_));
    return object_.finish();
  }

 private:
  static constexpr std::uint64_t kSize = 4;

  void check_fits(std::uint64_t count, std::uint64_t bytes, const char* what) const {
    if (count > bytes_.size() / bytes) {
      throw InputError(fmt::format("announces {} {}, more than fit into the rest of the file", count, what));
    }
  }

  void read_vertex(std::uint64_t size) {
    const auto number = [&](std::size_t i) {
      return static_cast<double>(load<float>(bytes_.data() + kSize * i, std::endian::big));
    };
    object_.add_vertex({number(0), number(1), number(2)}, 0);
    if (header_.normals && faces_ == 0) {
      object_.add_normal({number(3), number(4), number(5)});
    }
    bytes_.remove_prefix(size);
  }

  void read_face(std::uint64_t face) {
    const std::uint64_t corners = next_count("a number of corners");
    check_fits(corners, kSize, "corners");
    object_.begin_face();
    for (std::uint64_t i = 0; i < corners; ++i) {
      const std::uint64_t index = next_count("a vertex index");
      if (index >= vertices_) {
        throw InputError(fmt::format("face {}: {}", face, out_of_range(static_cast<std::int64_t>(index), vertices_)));
      }
      object_.add_corner(static_cast<std::uint32_t>(index));
    }
    const std::uint64_t colours = next_count("the numbers of a colour");
    check_fits(colours, kSize, "numbers of a colour");
    bytes_.remove_prefix(kSize * colours);
  }

  std::uint64_t next_count(const char* what) {
    if (bytes_.size() < kSize) {
      throw InputError(fmt::format("expected {}, but the file ends here", what));
    }
    const auto value = load<std::int32_t>(bytes_.data(), std::endian::big);
    if (value < 0) {
      throw InputError(fmt::format("expected {}, found {}", what, value));
    }
    bytes_.remove_prefix(kSize);
    return static_cast<std::uint64_t>(value);
  }

  std::string_view bytes_;
  Header header_;
  ObjectBuilder object_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
};

// What follows the line end at the beginning of `rest`, which no comment may precede in a binary file.
std::string_view behind_line(std::string_view rest) {
  const std::size_t end = rest.find('\n');
  return end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
}

Object read_off(const FileContent& file, const ReadLimits& limits) {
  TextCursor text(file.bytes);
  const Header header = read_header(text);
  if (!header.binary) {
    return TextOffReader(text, header, limits).read();
  }
  text.word();
  return BinaryOffReader(behind_line(text.rest()), header, limits).read();
}

}  // namespace

ObjectFormat off_format() {
  return {.extensions = {".off"}, .read = read_off, .likeness = likeness_of_off};
}

}  // namespace spincat::io
