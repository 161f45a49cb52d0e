// Settings as JSON, for model files and reports. Private: not installed.
#pragma once

#include <nlohmann/json.hpp>

#include "spincat/settings/settings.h"

namespace spincat {

nlohmann::ordered_json settings_to_json(const Settings& settings);

// Throws InputError naming the field when one is missing, of another type, not known, or out of its range.
Settings settings_from_json(const nlohmann::json& json);

}  // namespace spincat
