// Settings as a user chooses them: a preset, and what is to be different.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "spincat/settings/settings.h"

namespace spincat {

// One setting that a user asked for.
struct ChosenSetting {
  std::string name;   // as find_setting (setting_table.h) takes it
  std::string text;   // its value
  std::string label;  // how messages call it: "--copies"; empty: by its name
};

// The base comes first. Then what the chosen settings bring with them: a kernel its C, views their smaller images. Then
// the chosen values themselves, so that these always hold.
struct SettingChoices {
  Settings base;
  std::vector<ChosenSetting> chosen;

  SettingChoices(Settings settings_before = preset("default"), std::vector<ChosenSetting> wanted = {})  // NOLINT
      : base(std::move(settings_before)), chosen(std::move(wanted)) {}

  // These choices and one more, which replaces the one with the same name.
  SettingChoices with(ChosenSetting one) const;

  // Throws InputError when there is no such setting, a value is of another type or out of range, a chosen setting is
  // without effect beside the others, or settings cannot go together.
  Settings settings() const;
};

}  // namespace spincat
