// A line that names the columns of a file of points. Private to io.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace spincat::io {

struct ColumnNames {
  // The columns of x, y, z and, where has_normals, of nx, ny, nz; counted from 0.
  std::array<std::size_t, 6> places{};
  bool has_normals = false;
  std::size_t columns = 0;
  std::size_t line = 0;
};

// The columns that a line names, as in "X Y Z R G B" or "x,y,z,nx,ny,nz", upper or lower case; nothing where it names
// no x, y and z.
std::optional<ColumnNames> column_names(std::string_view line);

// The same of the comments above the first line that is none ("//X,Y,Z"). All their words must be names that are in
// use, as a comment may speak of x, y and z without naming columns.
std::optional<ColumnNames> column_names_in_comments(std::string_view text);

}  // namespace spincat::io
