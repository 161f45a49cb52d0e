#include "spincat/dataset/dataset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "spincat/dataset/category_map.h"
#include "spincat/dataset/listing.h"
#include "spincat/dataset/object_files.h"
#include "spincat/dataset/words.h"
#include "spincat/error.h"
#include "spincat/files/paths.h"
#include "spincat/io/read_object.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDatasetKinds =
    "a data set is a folder with a sub-folder for each category, a CSV file (.csv) with the columns path,category, or "
    "a "
    "classification file (.cla) of the Princeton Shape Benchmark";

// An object with its category by name: indices are given when all categories are known.
struct NamedObject {
  fs::path file;
  const std::string* category;
  std::string split;
  const fs::path* source;
};

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

// The .cla files of a folder laid out as the Princeton Shape Benchmark is; none where it is not.
std::vector<fs::path> classification_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (is_folder(folder / "db") && is_folder(folder / "classification")) {
    std::error_code error;
    for (fs::directory_iterator next(folder / "classification", error); !error && next != fs::directory_iterator();
         next.increment(error)) {
      const bool is_hidden = next->path().filename().native().starts_with('.');  // "._train.cla" from a Macintosh
      if (!is_hidden && lower_extension(next->path()) == ".cla") {
        expect_regular(next->path());
        files.push_back(next->path());
      }
    }
    if (error) {
      throw InputError((folder / "classification").string(), "cannot be read: " + error.message());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void list_source(const fs::path& source, const fs::path& models, const ReadLimits& limits,
                 std::vector<Listing>& listings) {
  std::error_code error;
  const fs::file_status status = fs::status(source, error);
  if (!fs::exists(status)) {
    const bool is_missing = status.type() == fs::file_type::not_found;
    throw InputError(source.string(), is_missing ? "no such file or folder" : "cannot be read: " + error.message());
  }
  const std::string extension = lower_extension(source);
  if (fs::is_directory(status)) {
    const std::vector<fs::path> files = classification_files(source);
    for (const fs::path& file : files) {
      listings.push_back(list_cla(file, models.empty() ? source / "db" : models, limits));
    }
    if (files.empty()) {
      listings.push_back(list_folder(source));
    }
  } else if (extension == ".csv" || extension == ".tsv") {
    listings.push_back(list_csv(source, models, limits));
  } else if (extension == ".cla") {
    listings.push_back(list_cla(source, models, limits));
  } else {
    throw InputError(source.string(),
                     fmt::format("is {}: {}", is_object_file(source) ? "one object, not a data set" : "not a data set",
                                 kDatasetKinds));
  }
}

// Why a listed file cannot be an object, or nothing.
std::optional<std::string> why_unusable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found || error == std::errc::too_many_symbolic_link_levels) {
    return "no such file";
  }
  if (!fs::status_known(status)) {
    return "cannot be read: " + error.message();
  }
  if (!fs::is_regular_file(status)) {
    return fs::is_directory(status) ? "is a folder" : "is not a regular file";
  }
  if (!has_object_name(file)) {
    return fmt::format("objects of this format are not read (extension {})", in_quotes(file.extension().string()));
  }
  return std::nullopt;
}

std::vector<const std::string*> names_of(const std::vector<ListedClass>& classes) {
  std::vector<const std::string*> names;
  names.reserve(classes.size());
  for (const ListedClass& listed : classes) {
    names.push_back(&listed.name);
  }
  return names;
}

// Everything that the listings name and that is there; the rest goes to `skipped`. Takes the objects out of the
// listings, which may name a million of them, and refers to what is left there and to the map.
std::vector<NamedObject> gather(std::vector<Listing>& listings, const std::optional<CategoryMap>& map,
                                std::vector<SkippedObject>& skipped) {
  std::vector<NamedObject> objects;
  for (Listing& listing : listings) {
    skipped.insert(skipped.end(), listing.skipped.begin(), listing.skipped.end());
    const std::vector<const std::string*> categories =
        map ? map->categories_of(listing.classes) : names_of(listing.classes);
    for (ListedObject& object : listing.objects) {
      const std::string* category = categories[object.listed_class];
      if (category == nullptr) {
        continue;
      }
      if (auto reason = why_unusable(object.file)) {
        skipped.push_back({std::move(object.file), *std::move(reason)});
      } else {
        objects.push_back({std::move(object.file), category, std::move(object.split), &listing.source});
      }
    }
    listing.objects = {};
  }
  return objects;
}

// Where a file really is, so that it is known again under another name.
fs::path real_path(const fs::path& file) {
  std::error_code error;
  fs::path real = fs::canonical(file, error);
  return error ? file : real;
}

void check_same(const NamedObject& first, const NamedObject& second, std::string_view what, const std::string& a,
                const std::string& b) {
  if (a != b) {
    const std::string other_name =
        first.file == second.file ? "" : fmt::format(" (there called {})", in_quotes(second.file.string()));
    throw InputError(first.file.string(),
                     fmt::format("is of {} {} in {} but of {} in {}{}", what, in_quotes(a), first.source->string(),
                                 in_quotes(b), second.source->string(), other_name));
  }
}

// Sorts by file and keeps each file once, under the name that sorts first.
std::vector<NamedObject> each_once(std::vector<NamedObject> objects) {
  std::stable_sort(objects.begin(), objects.end(),
                   [](const NamedObject& a, const NamedObject& b) { return a.file.native() < b.file.native(); });
  std::vector<NamedObject> result;
  std::unordered_map<std::string, std::size_t> place;
  for (NamedObject& object : objects) {
    const auto [found, is_new] = place.emplace(real_path(object.file).string(), result.size());
    if (is_new) {
      result.push_back(std::move(object));
      continue;
    }
    NamedObject& first = result[found->second];
    check_same(first, object, "category", *first.category, *object.category);
    if (first.split.empty()) {
      first.split = object.split;
    } else if (!object.split.empty()) {
      check_same(first, object, "split", first.split, object.split);
    }
  }
  return result;
}

// Numbers the categories by their names.
void fill(Dataset& dataset, std::vector<NamedObject> objects) {
  std::map<std::string, std::uint32_t> number_of;
  for (const NamedObject& object : objects) {
    number_of.emplace(*object.category, 0);
  }
  for (auto& [name, number] : number_of) {
    number = static_cast<std::uint32_t>(dataset.categories.size());
    dataset.categories.push_back(name);
  }
  for (NamedObject& object : objects) {
    dataset.objects.push_back({std::move(object.file), number_of.at(*object.category), std::move(object.split)});
  }
}

// What was skipped may be why too little is left.
void check_enough(const Dataset& dataset) {
  const auto& skipped = dataset.skipped;
  const std::string why = skipped.empty() ? ""
                                          : fmt::format("; {} skipped, the first is {} ({})", skipped.size(),
                                                        shown(skipped[0].file.string()), skipped[0].reason);
  if (dataset.objects.empty()) {
    throw InputError(dataset.name, "no object is left" + why);
  }
  if (dataset.categories.size() == 1) {
    throw InputError(dataset.name, fmt::format("only one category ({}): two or more are needed{}",
                                               in_quotes(dataset.categories[0]), why));
  }
}

// Nothing is of a category and of none.
void check_apart(const Dataset& dataset) {
  for (const fs::path& other : dataset.others) {
    if (std::ranges::binary_search(dataset.objects, other, {}, &DatasetObject::file)) {
      throw InputError(other.string(), "is an object of a category and among those of none");
    }
  }
}

}  // namespace

Dataset read_dataset(const std::vector<fs::path>& sources, const DatasetOptions& options) {
  if (sources.empty()) {
    throw InputError("no data set is named");
  }
  if (!options.models.empty() && !is_folder(options.models)) {
    throw InputError(options.models.string(), "no such folder (expected the folder that holds the models)");
  }
  std::optional<CategoryMap> map;
  if (!options.category_map.empty()) {
    map = CategoryMap::read(options.category_map);
  }
  Dataset dataset;
  dataset.limits = options.limits;
  std::vector<Listing> listings;
  for (const fs::path& source : sources) {
    dataset.name += (dataset.name.empty() ? "" : ", ") + source.string();
    list_source(source, options.models, options.limits, listings);
  }
  std::vector<NamedObject> objects = gather(listings, map, dataset.skipped);
  if (map) {
    for (const std::string& name : map->unknown_classes(listings)) {
      dataset.skipped.push_back(
          {options.category_map, fmt::format("no class of the data set is called {}", in_quotes(name))});
    }
  }
  fill(dataset, each_once(std::move(objects)));
  check_enough(dataset);
  if (!options.others.empty()) {
    dataset.others = read_objects(options.others, options.others_models);
    check_apart(dataset);
  }
  return dataset;
}

}  // namespace spincat
