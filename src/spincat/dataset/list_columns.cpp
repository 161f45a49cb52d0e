#include "spincat/dataset/list_columns.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace spincat {

namespace fs = std::filesystem;

std::size_t path_column(const CsvTable& table) {
  return table.column({"path", "file", "filename", "file_name", "filepath", "file_path", "object_path"});
}

std::size_t category_column(const CsvTable& table) {
  return table.column({"category", "label", "class", "class_name", "classname"});
}

std::optional<std::size_t> split_column(const CsvTable& table) {
  return table.find_column("split");
}

fs::path listed_file(const fs::path& folder, std::string_view name) {
  const fs::path file = folder / name;
  if (name.find('\\') == std::string_view::npos) {
    return file;
  }
  std::string parted(name);
  std::ranges::replace(parted, '\\', '/');
  std::error_code ignored;
  const fs::path other = folder / parted;
  return !fs::exists(file, ignored) && fs::exists(other, ignored) ? other : file;
}

}  // namespace spincat
