#include "settings.h"

#include <pybind11/stl.h>

#include <type_traits>
#include <variant>
#include <vector>

#include "bindings.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

// As set_setting takes it.
std::string value_text(const py::handle& value) {
  const auto text = py::str(value).cast<std::string>();
  return text == "True" ? "true" : text == "False" ? "false" : text;
}

py::object value_of(Settings& settings, const Setting& setting) {
  return std::visit(
      [&](auto* member) -> py::object {
        if constexpr (std::is_enum_v<std::remove_pointer_t<decltype(member)>>) {
          return py::str(setting_text(settings, setting));
        } else {
          return py::cast(*member);
        }
      },
      setting.member(settings));
}

}  // namespace

Settings settings_of(const std::string& preset_name, const py::dict& chosen, SettingStage last) {
  SettingChoices choices(preset(preset_name));
  for (const auto& [name, value] : chosen) {
    if (value.is_none()) {
      continue;
    }
    const auto key = name.cast<std::string>();
    const Setting& setting = find_setting(key);
    if (setting.stage > last) {
      throw InputError(key + ": has no effect here: it decides about what judges learn");
    }
    choices = choices.with({key, value_text(value), {}});
  }
  return choices.settings();
}

py::dict dict_of(const Settings& settings) {
  Settings copy = settings;
  py::dict result;
  result["preset"] = settings.preset;
  for (const Setting& setting : setting_table()) {
    result[py::str(std::string(setting.name))] = value_of(copy, setting);
  }
  return result;
}

int threads_of(int threads) {
  constexpr Range kThreads{1, 4096};
  check_range("threads", threads, kThreads);
  return threads;
}

void bind_settings(py::module_& module) {
  module.def("settings", [](const std::string& preset_name, const py::dict& chosen) {
    return dict_of(settings_of(preset_name, chosen));
  });
  module.def("setting_help", [] {
    py::dict help;
    for (const Setting& setting : setting_table()) {
      help[py::str(std::string(setting.name))] = std::string(setting.help);
    }
    return help;
  });
  module.def("presets", [] { return preset_names(); });
}

}  // namespace spincat::python
