#include "spincat/dataset/listing.h"

#include <algorithm>
#include <system_error>

#include "spincat/dataset/csv_reader.h"
#include "spincat/files/paths.h"

namespace spincat {

ListBuilder::ListBuilder(const std::filesystem::path& source, std::uint64_t file_size, const ReadLimits& limits)
    : listing_{.source = source, .classes = {}, .objects = {}, .skipped = {}}, file_size_(file_size), limits_(limits) {}

// Measured: tests/fuzz/large_test.cpp.
void ListBuilder::add_class(ListedClass listed) {
  constexpr std::uint64_t kBytes = 300;
  add_memory(kBytes + 2 * listed.name.size());
  listing_.classes.push_back(std::move(listed));
}

void ListBuilder::add_object(ListedObject object) {
  constexpr std::uint64_t kBytes = 900;
  add_memory(kBytes + 4 * object.file.native().size());
  listing_.objects.push_back(std::move(object));
}

void ListBuilder::add_memory(std::uint64_t bytes) {
  memory_ += bytes;
  naming_file(listing_.source, [&] { check_growth(memory_, file_size_, limits_); });
}

std::size_t path_column(const CsvTable& table) {
  return table.column({"path", "file", "filename", "file_name", "filepath", "file_path", "object_path"});
}

std::size_t category_column(const CsvTable& table) {
  return table.column({"category", "label", "class", "class_name", "classname"});
}

std::optional<std::size_t> split_column(const CsvTable& table) {
  return table.find_column("split");
}

std::filesystem::path listed_file(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path file = folder / name;
  if (name.find('\\') == std::string_view::npos) {
    return file;
  }
  std::string parted(name);
  std::ranges::replace(parted, '\\', '/');
  std::error_code ignored;
  const std::filesystem::path other = folder / parted;
  return !std::filesystem::exists(file, ignored) && std::filesystem::exists(other, ignored) ? other : file;
}

}  // namespace spincat
