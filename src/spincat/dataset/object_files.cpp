#include "spincat/dataset/object_files.h"

#include <algorithm>

#include "spincat/dataset/csv_reader.h"
#include "spincat/error.h"
#include "spincat/io/read_object.h"

namespace spincat {

namespace fs = std::filesystem;

std::vector<fs::path> object_files_below(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> files;
  error.clear();
  for (fs::recursive_directory_iterator it(folder, error), end; it != end && !error; it.increment(error)) {
    std::error_code ignored;
    if (it->is_regular_file(ignored) && is_object_file(it->path())) {
      files.push_back(it->path());
    }
  }
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> read_objects(const fs::path& source, const fs::path& models) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::is_directory(source, error)) {
    files = object_files_below(source, error);
    if (error) {
      throw InputError(source.string(), "a folder in it cannot be read: " + error.message());
    }
  } else {
    const CsvTable table = read_csv_table(source);
    const std::size_t path = table.column("path");
    const fs::path folder = models.empty() ? source.parent_path() : models;
    for (const CsvRow& row : table.rows) {
      files.push_back(folder / table.filled(row, path));
    }
    std::ranges::sort(files);
    const auto rest = std::ranges::unique(files);
    files.erase(rest.begin(), rest.end());
  }
  if (files.empty()) {
    throw InputError(source.string(), "names no object");
  }
  return files;
}

}  // namespace spincat
