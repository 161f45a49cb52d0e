#include "spincat/settings/settings_json.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <type_traits>

#include "spincat/error.h"
#include "spincat/settings/setting_names.h"
#include "spincat/settings/setting_table.h"
#include "spincat/settings/whole_number.h"

namespace spincat {
namespace {

using Json = nlohmann::json;

// The value of a setting in JSON, which knows how to be read into a member of any type.
struct Field {
  const Json& json;
  const std::string& name;

  template <class T>
  T get() const {
    try {
      return json.get<T>();
    } catch (const Json::exception&) {
      throw InputError(fmt::format("setting '{}' is of the wrong type", name));
    }
  }

  std::string text() const {
    auto value = get<std::string>();
    if (!is_setting_text(value)) {
      throw InputError(fmt::format("setting '{}' is too long or not printable", name));
    }
    return value;
  }

  void into(double& value) const { value = get<double>(); }
  void into(bool& value) const { value = get<bool>(); }
  void into(std::string& value) const { value = text(); }
  template <class T>
  void into(T& value) const {
    if constexpr (std::is_enum_v<T>) {
      value = choice_of<T>(name, text());
    } else {  // a whole number: a fraction, or a number beyond the type, is not quietly cut
      const std::optional<T> number = whole_number<T>(json);
      if (!number) {
        throw InputError(fmt::format("setting '{}' is not a whole number in range", name));
      }
      value = *number;
    }
  }
};

Field field_of(const Json& json, const std::string& name) {
  const auto at = json.find(name);
  if (at == json.end()) {
    throw InputError(fmt::format("setting '{}' is missing", name));
  }
  return {*at, name};
}

}  // namespace

nlohmann::ordered_json settings_to_json(const Settings& settings) {
  Settings copy = settings;  // a member is reached through settings that may change
  nlohmann::ordered_json json = {{"preset", settings.preset}};
  for (const Setting& setting : setting_table()) {
    nlohmann::ordered_json& value = json[std::string(setting.name)];
    std::visit(
        [&](const auto* member) {
          if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(*member)>>) {
            value = name_of(*member);
          } else {
            value = *member;
          }
        },
        setting.member(copy));
  }
  return json;
}

Settings settings_from_json(const Json& json) {
  Settings settings;
  const std::string preset = "preset";
  field_of(json, preset).into(settings.preset);
  for (const Setting& setting : setting_table()) {
    const std::string name(setting.name);
    const Field field = field_of(json, name);
    std::visit([&](auto* member) { field.into(*member); }, setting.member(settings));
  }
  settings.validate();
  return settings;
}

}  // namespace spincat
