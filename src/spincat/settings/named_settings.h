// Settings by their names, for varying any of them.
#pragma once

#include <string>
#include <string_view>

#include "spincat/settings/settings.h"

namespace spincat {

// The settings with one of them changed: `name` as in the JSON of settings, where blanks in words may be hyphens and a
// room may stand before a dot ("bin_size", "bin-size" and "spin.bin_size" are the same), `value` as text. Asking for a
// support angle means the hard one: angle_test becomes cutoff.
// Throws InputError that lists the names when there is none such, when the value is of another type, or when the
// settings are out of range with it.
Settings with_setting(const Settings& settings, std::string_view name, std::string_view value);

// The name as the JSON of settings has it. Throws as above.
std::string setting_name(std::string_view name);

}  // namespace spincat
