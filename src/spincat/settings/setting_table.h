// The one table of settings: from it come the options of every command, JSON, sweeps, the model file and
// docs/reference/settings.md. A new setting is a member of Settings and a row of this table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "spincat/range.h"
#include "spincat/settings/settings.h"

#pragma GCC visibility push(default)
namespace spincat {

// A member of Settings, whatever its type.
using SettingMember =
    std::variant<int*, double*, bool*, std::uint64_t*, std::string*, SurfaceKind*, NormalOrientation*, SpinConvention*,
                 Binning*, AngleTest*, BinSizeUnit*, KernelKind*, UpAxis*, TrainedFor*>;

// What a setting decides about, in the order of the road from an object to a name.
enum class SettingStage {
  points,    // which points stand for an object
  images,    // how a spin image is made
  features,  // how images become a feature vector
  training,  // what the judges learn, and how
};

struct Setting {
  std::string_view name;         // in JSON, model files and sweeps
  std::string_view option;       // on the command line, behind two hyphens
  std::string_view placeholder;  // for its value, in help
  std::string_view help;         // one line
  SettingStage stage = SettingStage::points;
  Range range;  // of numbers; choices have words (setting_words)
  SettingMember (*member)(Settings& settings) = nullptr;
  // Why the setting is without effect beside these others; empty where it has one. None: it always has.
  std::string (*no_effect)(const Settings& settings) = nullptr;
  // What else asking for this setting changes, unless it is asked for, too. None: nothing.
  void (*brings)(Settings& settings) = nullptr;
};

// All settings but the preset, in the order in which JSON has them.
std::span<const Setting> setting_table();

// The row with this name, where hyphens stand for blanks, too, and rooms may stand before a dot ("bin_size", "bin-size"
// and "spin.bin_size" are the same). Throws InputError that lists the names when there is none.
const Setting& find_setting(std::string_view name);

// The words that a choice may take, joined by commas: "vertices, samples, external"; empty for numbers and for true or
// false.
std::string setting_words(const Setting& setting);

// The value as text, as set_setting takes it.
std::string setting_text(const Settings& settings, const Setting& setting);

// Sets one member from text and nothing else. "bin_size" may have its unit behind it: "0.05rel", "2res", "3.5abs".
// Throws InputError "LABEL TEXT: expected ..." when the text is no value of its type, or out of range.
void set_setting(Settings& settings, const Setting& setting, std::string_view text, std::string_view label);

// Settings as a user chooses them: a preset, and what is to be different.

// One setting that a user asked for.
struct ChosenSetting {
  std::string name;   // as find_setting takes it
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
#pragma GCC visibility pop
