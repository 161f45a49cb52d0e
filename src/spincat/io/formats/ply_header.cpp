#include "spincat/io/formats/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace spincat::io::ply {
namespace {

ScalarType scalar_type(TextCursor& text) {
  struct TypeName {
    std::string_view name, sized_name;
    ScalarType type;
  };
  static constexpr std::array kTypes{
      TypeName{"char", "int8", ScalarType::int8},        TypeName{"uchar", "uint8", ScalarType::uint8},
      TypeName{"short", "int16", ScalarType::int16},     TypeName{"ushort", "uint16", ScalarType::uint16},
      TypeName{"int", "int32", ScalarType::int32},       TypeName{"uint", "uint32", ScalarType::uint32},
      TypeName{"float", "float32", ScalarType::float32}, TypeName{"double", "float64", ScalarType::float64},
  };
  const std::string_view word = text.word();
  for (const TypeName& type : kTypes) {
    if (word == type.name || word == type.sized_name) {
      return type.type;
    }
  }
  text.fail("unknown type " + in_quotes(word) + " of a property");
}

Encoding read_encoding(TextCursor& text) {
  const std::string_view word = text.word();
  if (word == "ascii") {
    return Encoding::ascii;
  }
  if (word == "binary_little_endian") {
    return Encoding::little_endian;
  }
  if (word == "binary_big_endian") {
    return Encoding::big_endian;
  }
  text.fail("unknown format " + in_quotes(word) + "; expected ascii, binary_little_endian or binary_big_endian");
}

Property read_property(TextCursor& text) {
  Property property;
  if (text.peek() == "list") {
    text.word();
    property.length_type = scalar_type(text);
  }
  property.type = scalar_type(text);
  property.name = text.word();
  return property;
}

// Each is compared with all before it.
constexpr std::size_t kMostElements = 100;

}  // namespace

Header read_header(TextCursor& text) {
  if (text.word() != "ply") {
    text.fail("expected the first line 'ply'");
  }
  Header header;
  bool formatted = false;
  for (text.skip_line(); text.word_follows(); text.skip_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "format") {
      header.encoding = read_encoding(text);
      formatted = true;
    } else if (keyword == "element") {
      const std::string name(text.word());
      if (header.find(name) != nullptr) {
        text.fail("a second element called " + in_quotes(name));
      }
      if (header.elements.size() == kMostElements) {
        text.fail(fmt::format("more than {} elements", kMostElements));
      }
      header.elements.push_back({name, text.count("the number of elements"), {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) {
        text.fail("a property before the first element");
      }
      header.elements.back().properties.push_back(read_property(text));
    } else if (keyword == "end_header") {
      if (!formatted) {
        text.fail("the header has no line 'format'");
      }
      text.skip_line();
      return header;
    } else if (keyword != "comment" && keyword != "obj_info") {
      text.fail("unknown word " + in_quotes(keyword) + " in the header");
    }
  }
  text.fail("the file ends within the header, before 'end_header'");
}

}  // namespace spincat::io::ply
