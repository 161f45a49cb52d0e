// The words for the choices in settings: on the command line, in model files and in reports.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "spincat/settings/settings.h"

namespace spincat {

template <class Choice>
struct ChoiceName {
  Choice choice;
  std::string_view name;
};

// All choices of a type, with their names.
template <class Choice>
std::span<const ChoiceName<Choice>> choices();
template <>
std::span<const ChoiceName<SurfaceKind>> choices();
template <>
std::span<const ChoiceName<NormalOrientation>> choices();
template <>
std::span<const ChoiceName<SpinConvention>> choices();
template <>
std::span<const ChoiceName<Binning>> choices();
template <>
std::span<const ChoiceName<AngleTest>> choices();
template <>
std::span<const ChoiceName<BinSizeUnit>> choices();
template <>
std::span<const ChoiceName<KernelKind>> choices();
template <>
std::span<const ChoiceName<UpAxis>> choices();
template <>
std::span<const ChoiceName<TrainedFor>> choices();

// The name of a choice.
template <class Choice>
std::string_view name_of(Choice choice) {
  for (const auto& each : choices<Choice>()) {
    if (each.choice == choice) {
      return each.name;
    }
  }
  return "?";
}

// Whether this may be a setting's name or value at all, and may stand in a message: at most 64 bytes, all printable.
bool is_setting_text(std::string_view text);

// Throws InputError that lists the names: "surface 'x' is not known (one of ...)".
[[noreturn]] void throw_unknown_choice(std::string_view field, std::string_view name,
                                       std::span<const std::string_view> known);

// The choice called `name`. Throws InputError naming `field` and all choices when there is none.
template <class Choice>
Choice choice_of(std::string_view field, std::string_view name) {
  for (const auto& each : choices<Choice>()) {
    if (each.name == name) {
      return each.choice;
    }
  }
  std::vector<std::string_view> known;
  for (const auto& each : choices<Choice>()) {
    known.push_back(each.name);
  }
  throw_unknown_choice(field, name, known);
}

}  // namespace spincat
