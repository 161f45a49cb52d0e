// Files of objects that spincat does not read but knows by their extension, and the programs that convert them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace spincat {

struct UnreadFormat {
  std::string_view extension;  // in lower case, with its dot
  std::string_view name;       // as in "is a STEP file"
  std::string_view advice;     // what to do: "convert it with gmsh: gmsh a.step -2 -o a.stl"
};

// The row of an extension, in lower case with its dot; none where the extension tells nothing, or spincat reads it.
std::optional<UnreadFormat> unread_format(std::string_view extension);

// All rows, in the order of docs/reference/formats.md.
std::span<const UnreadFormat> unread_formats();

}  // namespace spincat
