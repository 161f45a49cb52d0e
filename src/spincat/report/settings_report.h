// The table of settings, for people and programs.
#pragma once

#include <cstddef>
#include <string>

namespace spincat {

// Name, range or words, and the default of each preset; one line a setting, and what it is for in a second one where
// the width allows. Ends with a line break.
std::string settings_list_text(std::size_t width);

// One object: {"settings": [{"name", "option", "stage", "help", "range" or "words" or neither, "defaults": {preset:
// value}}]}. Values are as settings have them in JSON.
std::string settings_list_json();

}  // namespace spincat
