// Private to this folder, not installed: what one source of a data set lists, before a category map is applied and
// before anybody looked whether the files are there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"

namespace spincat {

struct ListedClass {
  std::string name;
  std::optional<std::uint32_t> parent;  // index into Listing::classes, always smaller than its own
};

struct ListedObject {
  std::filesystem::path file;
  std::uint32_t listed_class = 0;  // index into Listing::classes
  std::string split;
};

struct Listing {
  std::filesystem::path source;  // for messages
  std::vector<ListedClass> classes;
  std::vector<ListedObject> objects;
  std::vector<SkippedObject> skipped;
};

// A folder with a sub-folder for each category. Throws InputError when a folder cannot be read or no object is found.
Listing list_folder(const std::filesystem::path& folder);

// A CSV file; relative paths start at `models`, or beside the CSV file where `models` is empty.
Listing list_csv(const std::filesystem::path& file, const std::filesystem::path& models);

// A classification file of the Princeton Shape Benchmark; `models` is the folder called db there, and is looked for
// beside the file where it is empty.
Listing list_cla(const std::filesystem::path& file, const std::filesystem::path& models);

}  // namespace spincat
