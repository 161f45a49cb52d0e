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

const std::string* CategoryMap::category_of(const Listing& listing, std::uint32_t listed_class) const {
  for (std::optional<std::uint32_t> next = listed_class; next; next = listing.classes[*next].parent) {
    if (const auto found = category_of_class_.find(listing.classes[*next].name); found != category_of_class_.end()) {
      return &found->second;
    }
  }
  return nullptr;
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
