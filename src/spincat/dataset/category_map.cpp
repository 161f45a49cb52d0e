#include "spincat/dataset/category_map.h"

#include <fmt/format.h>

#include <set>

#include "spincat/dataset/csv_reader.h"
#include "spincat/dataset/words.h"
#include "spincat/error.h"

namespace spincat {

CategoryMap CategoryMap::read(const std::filesystem::path& file) {
  CsvTable table(file);
  const std::size_t class_column = table.column("class");
  const std::size_t category_column = table.column("category");
  CategoryMap map;
  while (const auto row = table.next()) {
    const std::string& name = table.filled(*row, class_column);
    const std::string& category = table.filled(*row, category_column);
    const auto [found, is_new] = map.category_of_class_.emplace(name, category);
    if (!is_new && found->second != category) {
      throw InputError(table.file(),
                       at_line(row->line, fmt::format("class {} goes to {} here and to {} above", in_quotes(name),
                                                      in_quotes(category), in_quotes(found->second))));
    }
  }
  if (map.category_of_class_.empty()) {
    throw InputError(table.file(), "lists no class below its header line");
  }
  return map;
}

// Parents come first, so that each class takes one look: a chain of classes may be as long as a file.
std::vector<const std::string*> CategoryMap::categories_of(const std::vector<ListedClass>& classes) const {
  std::vector<const std::string*> categories;
  categories.reserve(classes.size());
  for (const ListedClass& listed : classes) {
    const auto found = category_of_class_.find(listed.name);
    const std::string* inherited = listed.parent ? categories[*listed.parent] : nullptr;
    categories.push_back(found != category_of_class_.end() ? &found->second : inherited);
  }
  return categories;
}

std::vector<std::string> CategoryMap::unknown_classes(const std::vector<Listing>& listings) const {
  std::set<std::string> known;
  for (const Listing& listing : listings) {
    for (const ListedClass& listed : listing.classes) {
      known.insert(listed.name);
    }
  }
  std::vector<std::string> unknown;
  for (const auto& [name, category] : category_of_class_) {
    if (!known.contains(name)) {
      unknown.push_back(name);
    }
  }
  return unknown;
}

}  // namespace spincat
