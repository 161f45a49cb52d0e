// What a user chooses against what a preset, and other choices, bring with them.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "spincat/settings/setting_table.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

using test::input_error;
using Chosen = std::vector<ChosenSetting>;

Settings chosen(const Chosen& settings, const std::string& name = "default") {
  return SettingChoices(preset(name), settings).settings();
}

std::string refusal(const Chosen& settings, const std::string& name = "default") {
  return input_error([&] { chosen(settings, name); });
}

TEST(SettingTable, EveryNameAndOptionIsThereOnce) {
  std::set<std::string_view> names;
  std::set<std::string_view> options;
  for (const Setting& setting : setting_table()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    EXPECT_TRUE(options.insert(setting.option).second) << setting.option;
    EXPECT_FALSE(setting.help.empty()) << setting.name;
    EXPECT_EQ(&find_setting(setting.name), &setting);
  }
  EXPECT_EQ(names.size(), 28U);
}

TEST(SettingTable, TextRoundTrips) {
  for (const std::string& name : preset_names()) {
    const Settings s = preset(name);
    for (const Setting& setting : setting_table()) {
      Settings other;
      set_setting(other, setting, setting_text(s, setting), setting.name);
      EXPECT_EQ(setting_text(other, setting), setting_text(s, setting)) << setting.name;
    }
  }
}

TEST(SettingTable, TakesNamesAsPeopleWriteThem) {
  for (const char* name : {"bin_size", "bin-size", "spin.bin_size", "a.b.bin-size"}) {
    EXPECT_EQ(chosen({{name, "0.125", ""}}).spin.bin_size, 0.125) << name;
  }
  EXPECT_EQ(refusal({{"colour", "1", ""}}).rfind("setting 'colour' is not known (one of surface, orientation, ", 0),
            0U);
  EXPECT_EQ(refusal({{"preset", "paper", ""}}).rfind("setting 'preset' is not known", 0), 0U);
}

TEST(SettingTable, RefusesValuesOfAnotherTypeAndOutOfRange) {
  EXPECT_EQ(refusal({{"copies", "1.5", ""}}), "copies 1.5: expected a whole number, 0 to 100");
  EXPECT_EQ(refusal({{"copies", "-1", "--copies"}}), "--copies -1: expected 0 to 100");
  EXPECT_EQ(refusal({{"spin-points", "0", "--spin-points"}}), "--spin-points 0: expected 1 to 10,000,000");
  EXPECT_EQ(refusal({{"c", "many", ""}}), "c many: expected a number");
  EXPECT_EQ(refusal({{"c", "nan", ""}}), "c nan: expected a number above 0");
  EXPECT_EQ(refusal({{"class_weights", "1", ""}}), "class_weights 1: expected true or false");
  EXPECT_EQ(refusal({{"seed", "-1", "--seed"}}), "--seed -1: expected a whole number from 0");
  EXPECT_EQ(refusal({{"seed", "18446744073709551616", ""}}),
            "seed 18446744073709551616: expected a whole number from 0");
  EXPECT_EQ(refusal({{"up", "w", "--up"}}), "--up 'w' is not known (one of none, x, y, z)");
}

TEST(SettingTable, ABinSizeMayHaveItsUnit) {
  const Settings s = chosen({{"bin_size", "2res", ""}});
  EXPECT_EQ(s.spin.bin_size, 2.0);
  EXPECT_EQ(s.bin_size_unit, BinSizeUnit::resolution);
  EXPECT_EQ(chosen({{"bin_size", "3.5abs", ""}}).bin_size_unit, BinSizeUnit::absolute);
  EXPECT_EQ(chosen({{"bin_size", "0.07", ""}}).bin_size_unit, BinSizeUnit::relative);
  EXPECT_EQ(refusal({{"bin_size", "2mm", "--bin-size"}}),
            "--bin-size 2mm: expected a number, maybe followed by abs, res or rel, as in 0.05rel");
  EXPECT_EQ(refusal({{"bin_size", "0rel", ""}}), "bin_size 0: expected a number above 0");
}

TEST(SettingChoices, WhatTheUserChoosesHoldsBesideViews) {
  for (const Chosen& settings : {Chosen{{"views", "2", ""}, {"points", "500", ""}, {"image_width", "16", ""}},
                                 Chosen{{"image_width", "16", ""}, {"points", "500", ""}, {"views", "2", ""}}}) {
    const Settings s = chosen(settings);
    EXPECT_EQ(s.prepare.points, 500);
    EXPECT_EQ(s.spin.image_width, 16);
    EXPECT_EQ(s.prepare.spin_points, 128);  // as views bring them
    EXPECT_EQ(s.views, 2);
    EXPECT_EQ(s.trained_for, TrainedFor::views);
    EXPECT_EQ(s.up, UpAxis::y);
  }
  EXPECT_EQ(chosen({{"views", "2", ""}, {"up", "z", ""}}).up, UpAxis::z);
  EXPECT_EQ(chosen({{"trained_for", "views", ""}}).views, 12);
}

TEST(SettingChoices, AKernelBringsItsC) {
  EXPECT_EQ(chosen({{"kernel", "rbf", ""}}).judge.c, 3.0);
  EXPECT_EQ(chosen({{"kernel", "rbf", ""}}).judge.dimensions, 0);
  EXPECT_EQ(chosen({{"kernel", "linear", ""}}).judge.c, 10.0);
  EXPECT_EQ(chosen({{"dimensions", "0", ""}}).judge.c, 200.0);
  EXPECT_EQ(chosen({{"dimensions", "50", ""}}, "paper").judge.c, 10.0);
  EXPECT_EQ(refusal({{"dimensions", "50", ""}, {"kernel", "rbf", ""}}),
            "dimensions need the linear kernel: rbf compares the features themselves");
  EXPECT_EQ(chosen({{"c", "10", ""}, {"kernel", "rbf", ""}}).judge.c, 10.0);
  EXPECT_EQ(chosen({{"kernel", "rbf", ""}, {"c", "10", ""}}).judge.c, 10.0);
}

TEST(SettingChoices, AnEncodingOfLocalFeaturesStandsAlone) {
  const Settings s = chosen({{"encoding", "bag-of-features", ""}});
  EXPECT_FALSE(s.plain_samples);
  EXPECT_FALSE(s.radial);
  EXPECT_EQ(s.judge.dimensions, 0);
  EXPECT_EQ(s.judge.c, 200.0);
  EXPECT_EQ(s.draws, 1);
  EXPECT_EQ(refusal({{"encoding", "bag-of-features", ""}, {"draws", "3", ""}}),
            "the encoding bag-of-features knows no radial part, no plain samples, no up axis and only one draw");
}

TEST(SettingChoices, AskingForAnAngleMeansTheHardOne) {
  const Settings s = chosen({{"support_angle", "60", ""}});
  EXPECT_EQ(s.spin.angle_test, AngleTest::cutoff);
  EXPECT_EQ(s.spin.support_angle, 60.0);
}

TEST(SettingChoices, WhatHasNoEffectIsRefused) {
  EXPECT_EQ(refusal({{"views", "12", "--views"}, {"trained_for", "any", "--for"}}),
            "--views 12: has no effect: judges that are trained for any see no views");
  EXPECT_EQ(refusal({{"views", "12", "--views"}, {"copies", "3", "--copies"}}),
            "--copies 3: has no effect: judges that learn by views are shown no copies");
  EXPECT_EQ(refusal({{"stretch", "0.1", ""}}, "paper"),
            "stretch 0.1: has no effect: there are no copies (copies is 0)");
  EXPECT_EQ(refusal({{"background", "9", ""}, {"dimensions", "0", ""}}),
            "background 9: has no effect: strangers are told in the small space of judges alone (dimensions is 0)");
  EXPECT_EQ(refusal({{"words", "64", ""}}), "words 64: has no effect: the encoding pooled-pyramid learns no codebook");
  EXPECT_EQ(refusal({{"points", "64", ""}}, "paper"),
            "points 64: has no effect: all vertices are taken with surface vertices");
  EXPECT_EQ(refusal({{"support_angle", "60", ""}, {"angle_test", "soft", ""}}),
            "support_angle 60: has no effect: no angle is left out with angle_test soft");
}

TEST(SettingChoices, TheLaterOfTwoReplacesTheFirst) {
  const SettingChoices choices = SettingChoices(preset("default"), {{"c", "5", "--c"}}).with({"judge.c", "7", ""});
  ASSERT_EQ(choices.chosen.size(), 1U);
  EXPECT_EQ(choices.settings().judge.c, 7.0);
}

}  // namespace
}  // namespace spincat
