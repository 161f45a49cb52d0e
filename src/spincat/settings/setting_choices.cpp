#include <fmt/format.h>

#include "spincat/error.h"
#include "spincat/settings/setting_table.h"

namespace spincat {
namespace {

std::string_view label_of(const ChosenSetting& one) {
  return one.label.empty() ? find_setting(one.name).name : std::string_view(one.label);
}

void refuse_without_effect(const Settings& settings, const ChosenSetting& one) {
  const Setting& setting = find_setting(one.name);
  const std::string reason = setting.no_effect != nullptr ? setting.no_effect(settings) : "";
  if (!reason.empty()) {
    throw InputError(fmt::format("{} {}: has no effect: {}", label_of(one), one.text, reason));
  }
}

}  // namespace

SettingChoices SettingChoices::with(ChosenSetting one) const {
  SettingChoices result = *this;
  std::erase_if(result.chosen,
                [&](const ChosenSetting& other) { return &find_setting(other.name) == &find_setting(one.name); });
  result.chosen.push_back(std::move(one));
  return result;
}

Settings SettingChoices::settings() const {
  Settings s = base;
  for (const ChosenSetting& one : chosen) {
    const Setting& setting = find_setting(one.name);
    set_setting(s, setting, one.text, label_of(one));
    if (setting.brings != nullptr) {
      setting.brings(s);
    }
  }
  for (const ChosenSetting& one : chosen) {
    set_setting(s, find_setting(one.name), one.text, label_of(one));
  }
  for (const ChosenSetting& one : chosen) {
    refuse_without_effect(s, one);
  }
  s.validate();
  return s;
}

}  // namespace spincat
