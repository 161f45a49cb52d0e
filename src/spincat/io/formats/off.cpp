// Object File Format, as Geomview defines it and as the world writes it.
#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

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

// A whole number, where the word is one.
std::optional<std::uint64_t> whole_number(std::string_view word) {
  std::uint64_t value = 0;
  const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && last == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

// Whether nothing but so many faces follow, with any blank between their numbers and without colours.
bool faces_flow(TextCursor text, std::uint64_t faces, std::uint64_t vertices) {
  const auto next = [&] { return text.word_follows() ? whole_number(text.word()) : std::nullopt; };
  for (std::uint64_t i = 0; i < faces; ++i) {
    const auto corners = next();
    for (std::uint64_t k = 0; corners && k < *corners; ++k) {
      const auto index = next();
      if (!index || *index >= vertices) {
        return false;
      }
    }
    if (!corners) {
      return false;
    }
  }
  return !text.word_follows() || is_padding(text.rest());
}

// The same for vertices of so many numbers, and then faces: these may have a line each, with a colour at its end.
bool vertices_flow(TextCursor text, std::uint64_t vertices, std::uint64_t numbers, std::uint64_t faces) {
  for (std::uint64_t i = 0; i < vertices * numbers; ++i) {
    if (!text.word_follows() || !is_number(text.word())) {
      return false;
    }
  }
  return (!text.word_on_line() && lines_with_words(text, faces + 1) == faces) || faces_flow(text, faces, vertices);
}

// As a rule a vertex or a face has a line, with a colour and more at its end. But any blank may part numbers, and
// whether it does is found out where a line first goes on behind a vertex or a face.
class TextOffReader {
 public:
  TextOffReader(TextCursor text, const Header& header, const ReadLimits& limits)
      : text_(text), header_(header), object_(limits) {}

  Object read() {
    read_counts();
    if (header_.numbers_of_vertex() > 3) {
      flow_ = vertices_flow(text_, vertices_, header_.numbers_of_vertex(), faces_);
    }
    const TextCursor begin = text_;
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      read_vertex(begin);
    }
    flow_.reset();
    for (std::uint64_t i = 0; i < faces_; ++i) {
      read_face(faces_ - i);
    }
    expect_end(text_, announced(vertices_, faces_));
    return object_.finish();
  }

 private:
  void read_counts() {
    text_.word_follows();
    vertices_ = text_.count("the number of vertices");
    const std::size_t line = text_.line();
    text_.word_follows();
    faces_ = text_.count("the number of faces");
    if (text_.line() != line && words_on_line(text_) == 0) {
      text_.word_follows();  // each has a line, and so has the number of edges
    }
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

  // `begin`: of the first.
  void read_vertex(const TextCursor& begin) {
    Vec3 vertex;
    for (double& coordinate : vertex) {
      text_.word_follows();
      coordinate = text_.number("a coordinate");
    }
    object_.add_vertex(vertex, text_.line());
    std::uint64_t read = 3;
    if (header_.normals && (faces_ == 0 || flow_ == true)) {
      add_normal();
      read += 3;
    }
    if (!flow_ && text_.word_on_line()) {
      flow_ = vertices_flow(begin, vertices_, header_.numbers_of_vertex(), faces_);
    }
    if (flow_ == true) {
      for (; read < header_.numbers_of_vertex(); ++read) {
        next_number("a number of a colour");
      }
      return;
    }
    if (!header_.colours && !header_.texture) {  // a colour may have three numbers or four
      ends_.check(text_);
    }
    text_.skip_line();
  }

  void add_normal() {
    Vec3 normal;
    for (double& component : normal) {
      component = next_number("a component of a normal");
    }
    if (faces_ == 0) {
      object_.add_normal(normal);
    }
  }

  double next_number(const char* what) {
    if (flow_ == true) {
      text_.word_follows();
    }
    return text_.number(what);
  }

  // `left`: the faces from this one on.
  void read_face(std::uint64_t left) {
    const TextCursor begin = text_;
    text_.word_follows();
    const std::size_t line = text_.line();
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
    if (!flow_ && text_.word_on_line()) {
      flow_ = faces_flow(begin, left, vertices_);
    }
    if (flow_ == true) {
      return;
    }
    if (text_.line() != line && text_.word_on_line()) {  // a vertex too many, most likely, read on into the first face
      text_.fail(fmt::format("the face that begins in line {} ends within this line", line));
    }
    text_.skip_line();  // a colour
  }

  TextCursor text_;
  Header header_;
  ObjectBuilder object_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
  std::optional<bool> flow_;  // of the vertices, then of the faces: whether they flow from line to line, once known
  RowEnds ends_;
};

// Integers and floats of four bytes, the largest first.
class BinaryOffReader {
 public:
  // `begin`: of the bytes in their file.
  BinaryOffReader(std::string_view bytes, std::size_t begin, const Header& header, const ReadLimits& limits)
      : bytes_(bytes), end_(begin + bytes.size()), header_(header), object_(limits) {}

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
      fail(fmt::format("announces {} {}, more than fit into the rest of the file", count, what));
    }
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("byte {}: {}", end_ - bytes_.size(), problem));
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
      fail(fmt::format("expected {}, but the file ends here", what));
    }
    const auto value = load<std::int32_t>(bytes_.data(), std::endian::big);
    if (value < 0) {
      fail(fmt::format("expected {}, found {}", what, value));
    }
    bytes_.remove_prefix(kSize);
    return static_cast<std::uint64_t>(value);
  }

  std::string_view bytes_;  // that are left
  std::size_t end_;
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
  const std::string_view body = behind_line(text.rest());
  return BinaryOffReader(body, file.bytes.size() - body.size(), header, limits).read();
}

}  // namespace

ObjectFormat off_format() {
  return {.extensions = {".off"}, .read = read_off, .likeness = likeness_of_off};
}

}  // namespace spincat::io
