#include "spincat/dataset/object_files.h"

#include <algorithm>

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

std::vector<fs::path> object_files_below(const fs::path& folder, std::vector<UnreadFolder>& unread) {
  std::vector<fs::path> files;
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
        files.push_back(it->path());
      }
    }
    if (error) {
      unread.push_back({current, error});
    }
  }
  std::ranges::sort(files);
  std::ranges::sort(unread, {}, &UnreadFolder::folder);
  return files;
}

std::vector<fs::path> read_objects(const fs::path& source, const fs::path& models) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::is_directory(source, error)) {
    std::vector<UnreadFolder> unread;
    files = object_files_below(source, unread);
    if (!unread.empty()) {
      throw InputError(unread[0].folder.string(), "cannot be read: " + unread[0].error.message());
    }
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
