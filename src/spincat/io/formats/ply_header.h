// The header of a PLY file. Private to io.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/io/formats/binary.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io::ply {

struct Property {
  std::string name;
  ScalarType type;                        // of a list: of its values
  std::optional<ScalarType> length_type;  // lists only
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;

  const Element* find(std::string_view name) const {
    const auto found = std::find_if(elements.begin(), elements.end(), [&](const Element& e) { return e.name == name; });
    return found == elements.end() ? nullptr : &*found;
  }
};

// Leaves the cursor behind the line of end_header.
Header read_header(TextCursor& text);

}  // namespace spincat::io::ply
