// Objects whose category is of no interest.
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace spincat {

// A folder that could not be read, and why.
struct UnreadFolder {
  std::filesystem::path folder;
  std::error_code error;
};

// All object files in a folder and the folders below it, sorted. A symbolic link to nowhere counts when its name is
// that of an object: whoever reads it says what is wrong. Folders that cannot be read are added to `unread`, and passed
// over.
std::vector<std::filesystem::path> object_files_below(const std::filesystem::path& folder,
                                                      std::vector<UnreadFolder>& unread);

// The objects that a source names: all object files below a folder, or the column `path` of a CSV file, whose paths are
// relative to `models` (empty: to the CSV file's own folder). Sorted, each once; the files of a CSV need not be there.
// Throws InputError when the source is missing, cannot be read or names no object.
std::vector<std::filesystem::path> read_objects(const std::filesystem::path& source,
                                                const std::filesystem::path& models = {});

}  // namespace spincat
