// Files of objects that spincat does not read but knows by their extension, and the programs that convert them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace spincat {

struct UnreadFormat {
  std::string_view extension;  // in lower case, with its dot
  std::string_view name;       // as in "is a STEP file"
  std::string_view advice;     // what to do: "convert it with gmsh: gmsh a.step -2 -o a.stl"
};

// The row of an extension, in lower case with its dot; none where the extension tells nothing, or spincat reads it.
std::optional<UnreadFormat> unread_format(std::string_view extension);

// Counts the files in such formats that somebody meets in a folder.
class UnreadFiles {
 public:
  // Counts the file if its extension is that of one.
  void look_at(const std::filesystem::path& file);
  bool empty() const { return counts_.empty(); }
  // "5 files in formats that spincat does not read: .step 3, .blend 2", the most first.
  std::string text() const;

 private:
  std::map<std::string, std::size_t> counts_;  // by extension
};

// All rows, in the order of docs/reference/formats.md.
std::span<const UnreadFormat> unread_formats();

}  // namespace spincat
