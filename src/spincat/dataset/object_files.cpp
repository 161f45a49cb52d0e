#include "spincat/dataset/object_files.h"

#include <algorithm>
#include <utility>

#include "spincat/dataset/csv_reader.h"
#include "spincat/dataset/listing.h"
#include "spincat/error.h"
#include "spincat/files/paths.h"
#include "spincat/io/read_object.h"

namespace spincat {

namespace fs = std::filesystem;

namespace {

bool names_an_object(const fs::directory_entry& entry) {
  std::error_code ignored;
  return is_object_file(entry.path()) && is_regular_or_missing(entry.status(ignored));
}

}  // namespace

ObjectFiles object_files_below(const fs::path& folder) {
  ObjectFiles found;
  std::vector<fs::path> folders = {folder};
  while (!folders.empty()) {
    const fs::path current = folders.back();
    folders.pop_back();
    std::error_code error;
    for (fs::directory_iterator it(current, error), end; !error && it != end; it.increment(error)) {
      std::error_code ignored;
      if (it->symlink_status(ignored).type() == fs::file_type::directory) {
        folders.push_back(it->path());
      } else if (names_an_object(*it)) {
        found.files.push_back(it->path());
      } else {
        found.unread_files.look_at(it->path());
      }
    }
    if (error) {
      found.unread_folders.push_back({current, error});
    }
  }
  std::ranges::sort(found.files);
  std::ranges::sort(found.unread_folders, {}, &UnreadFolder::folder);
  return found;
}

std::vector<fs::path> read_objects(const fs::path& source, const fs::path& models) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::is_directory(source, error)) {
    ObjectFiles found = object_files_below(source);
    if (!found.unread_folders.empty()) {
      const auto& [unread, reason] = found.unread_folders[0];
      throw InputError(unread.string(), "cannot be read: " + reason.message());
    }
    files = std::move(found.files);
  } else {
    CsvTable table(source);
    const std::size_t path = path_column(table);
    const fs::path folder = models.empty() ? source.parent_path() : models;
    while (const auto row = table.next()) {
      files.push_back(listed_file(folder, table.filled(*row, path)));
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
