#include "spincat/settings/named_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "spincat/error.h"
#include "spincat/settings/setting_names.h"
#include "spincat/settings/settings_json.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;

// The value in the type that the setting has.
Json typed_value(const std::string& name, std::string_view text, const Json& like) {
  if (like.is_string()) {
    return text;
  }
  Json value = Json::parse(text, nullptr, false);
  const bool fits = like.is_boolean()        ? value.is_boolean()
                    : like.is_number_float() ? value.is_number()
                                             : value.is_number_integer();
  if (!fits) {
    const char* const wanted = like.is_boolean()        ? "true or false"
                               : like.is_number_float() ? "a number"
                                                        : "a whole number";
    throw InputError(fmt::format("setting {}: expected {}, not '{}'", name, wanted, text));
  }
  return value;
}

}  // namespace

std::string setting_name(std::string_view name) {
  if (!is_setting_text(name)) {
    throw InputError("a setting's name is too long or not printable");
  }
  std::string key(name.substr(name.rfind('.') == std::string_view::npos ? 0 : name.rfind('.') + 1));
  std::ranges::replace(key, '-', '_');
  const Json known = settings_to_json(Settings{});
  if (!known.contains(key) || key == "preset") {
    std::vector<std::string> names;
    for (const auto& [each, value] : known.items()) {
      if (each != "preset") {
        names.push_back(each);
      }
    }
    throw InputError(fmt::format("setting '{}' is not known (one of {})", name, fmt::join(names, ", ")));
  }
  return key;
}

Settings with_setting(const Settings& settings, std::string_view name, std::string_view value) {
  const std::string key = setting_name(name);
  if (!is_setting_text(value)) {
    throw InputError(fmt::format("setting {}: its value is too long or not printable", key));
  }
  Json json = settings_to_json(settings);
  json[key] = typed_value(key, value, json[key]);
  if (key == "support_angle") {
    json["angle_test"] = "cutoff";
  }
  return settings_from_json(json);
}

}  // namespace spincat
