// Which classes of a source to keep, and what to call them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "spincat/dataset/listing.h"

namespace spincat {

class CategoryMap {
 public:
  // A CSV file with the columns class,category. Throws InputError when it is malformed, lists nothing, or sends one
  // class to two categories.
  static CategoryMap read(const std::filesystem::path& file);

  // The category of each class, by the nearest of itself and its ancestors that the map lists; nullptr where there is
  // none.
  std::vector<const std::string*> categories_of(const std::vector<ListedClass>& classes) const;

  // The classes of the map that no source knows, sorted: most likely a spelling mistake.
  std::vector<std::string> unknown_classes(const std::vector<Listing>& listings) const;

 private:
  std::map<std::string, std::string> category_of_class_;
};

}  // namespace spincat
