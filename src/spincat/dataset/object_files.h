// Objects whose category is of no interest.
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

#include "spincat/io/unread_format.h"

namespace spincat {

// A folder that could not be read, and why.
struct UnreadFolder {
  std::filesystem::path folder;
  std::error_code error;
};

// What a folder and the folders below it hold.
struct ObjectFiles {
  std::vector<std::filesystem::path> files;  // of objects, sorted
  std::vector<UnreadFolder> unread_folders;  // sorted
  UnreadFiles unread_files;                  // objects in other formats
};

// A symbolic link to nowhere counts as an object when its name is that of one: whoever reads it says what is wrong.
ObjectFiles object_files_below(const std::filesystem::path& folder);

// The objects that a source names: all object files below a folder, or the column `path` of a CSV file, whose paths are
// relative to `models` (empty: to the CSV file's own folder). Sorted, each once; the files of a CSV need not be there.
// Throws InputError when the source is missing, cannot be read or names no object.
std::vector<std::filesystem::path> read_objects(const std::filesystem::path& source,
                                                const std::filesystem::path& models = {});

}  // namespace spincat
