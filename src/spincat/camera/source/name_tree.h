// Numbers by their names: what JSON, YAML and lines "name = value" have in common.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spincat {

struct NameTree {
  struct Group {
    std::size_t parent = 0;
    std::string name;  // in lower case, its first 64 characters; of an item of a list empty
  };
  struct Entry {
    std::size_t group = 0;
    std::string name;             // as a group's
    std::vector<double> numbers;  // its first 17: those of lists of lists one after the other
    std::size_t line = 0;
  };
  std::vector<Group> groups;   // the first is that of the whole text
  std::vector<Entry> entries;  // in the order of the text
};

// The entries whose name `is_wanted`, with the numbers that follow it. A name ends at ':' or '='; "a.b" is b in the
// group a. Groups are in braces or farther to the right than their name, as in YAML. Words that are no numbers are
// passed over. Throws InputError (without a file name) where a bracket is not closed, or there is more than a
// calibration has: 1 MB, 32 groups in each other, 20,000 entries.
NameTree read_name_tree(std::string_view text, bool (*is_wanted)(std::string_view name));

}  // namespace spincat
