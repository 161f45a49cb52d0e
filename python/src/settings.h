// Settings as Python gives them: a preset, and a dict of what is to be different.
#pragma once

#include <pybind11/pybind11.h>
#include <spincat/spincat.h>

#include <string>

namespace spincat::python {

// Values are numbers, texts, True or False; None stands for the preset's. Throws InputError as SettingChoices does, and
// for a setting of a later stage than `last`, which would be without effect.
Settings settings_of(const std::string& preset_name, const pybind11::dict& chosen,
                     SettingStage last = SettingStage::training);

// All settings and the preset, by name.
pybind11::dict dict_of(const Settings& settings);

// The same number. Throws InputError unless it is 1 to 4,096.
int threads_of(int threads);

}  // namespace spincat::python
