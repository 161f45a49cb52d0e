// What one source of a data set lists, before a category map is applied and
// before anybody looked whether the files are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/io/read_limits.h"

namespace spincat {

class CsvTable;

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

// Fills a listing from a file. A few bytes of it may name an object, which takes far more memory: each addition throws
// InputError, with the file, where that is too much for a file of this size (check_growth).
class ListBuilder {
 public:
  ListBuilder(const std::filesystem::path& source, std::uint64_t file_size, const ReadLimits& limits);

  const std::filesystem::path& source() const { return listing_.source; }
  std::uint32_t classes() const { return static_cast<std::uint32_t>(listing_.classes.size()); }
  std::size_t objects() const { return listing_.objects.size(); }
  void add_class(ListedClass listed);
  void add_object(ListedObject object);
  Listing take() { return std::move(listing_); }

 private:
  void add_memory(std::uint64_t bytes);

  Listing listing_;
  std::uint64_t file_size_;
  ReadLimits limits_;
  std::uint64_t memory_ = 0;  // what the objects take until the data set is made of them
};

// The columns of a list of objects, by the names that lists in use have for them. The first two throw InputError when
// there is none.
std::size_t path_column(const CsvTable& table);
std::size_t category_column(const CsvTable& table);
std::optional<std::size_t> split_column(const CsvTable& table);

// The file that a list calls `name`, relative to a folder. Backslashes part folders where a file is found so, and none
// of the name as it stands.
std::filesystem::path listed_file(const std::filesystem::path& folder, std::string_view name);

// A folder with a sub-folder for each category. Throws InputError when a folder cannot be read or no object is found.
Listing list_folder(const std::filesystem::path& folder);

// A CSV file; relative paths start at `models`, or beside the CSV file where `models` is empty.
Listing list_csv(const std::filesystem::path& file, const std::filesystem::path& models, const ReadLimits& limits = {});

// A classification file of the Princeton Shape Benchmark; `models` is the folder called db there, and is looked for
// beside the file where it is empty.
Listing list_cla(const std::filesystem::path& file, const std::filesystem::path& models, const ReadLimits& limits = {});

}  // namespace spincat
