#include "spincat/settings/settings.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "spincat/settings/setting_names.h"
#include "spincat/settings/settings_json.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

using test::input_error;
using Json = nlohmann::json;

// Every field other than it is by default.
Settings unusual() {
  Settings s;
  s.preset = "paper";
  s.prepare.surface = SurfaceKind::samples;
  s.prepare.orientation = NormalOrientation::as_given;
  s.prepare.points = 123;
  s.prepare.spin_points = 45;
  s.prepare.neighbours = 6;
  s.spin.convention = SpinConvention::pcl;
  s.spin.image_width = 9;
  s.spin.bin_size = 0.1 + 0.2;
  s.spin.support_angle = 77.7;
  s.bin_size_unit = BinSizeUnit::resolution;
  s.encoding = "concatenation";
  s.radial = true;
  s.plain_samples = true;
  s.up = UpAxis::y;
  s.draws = 3;
  s.trained_for = TrainedFor::any;
  s.words = 99;
  s.judge.dimensions = 33;
  s.judge.c = 1.0 / 3.0;
  s.judge.class_weights = false;
  s.copies = 2;
  s.views = 7;
  s.stretch = 0.125;
  s.background = 5;
  s.seed = std::numeric_limits<std::uint64_t>::max();
  return s;
}

Json json_of(const Settings& settings) {
  return Json::parse(settings_to_json(settings).dump());
}

std::string error_of(const Json& json) {
  return input_error([&] { settings_from_json(json); });
}

std::string error_with(const char* field, const Json& value) {
  Json json = json_of(preset("default"));
  EXPECT_TRUE(json.contains(field));
  json[field] = value;
  return error_of(json);
}

TEST(SettingsJson, RoundTripsEveryField) {
  const Settings s = unusual();
  const Settings back = settings_from_json(json_of(s));
  EXPECT_EQ(back.preset, s.preset);
  EXPECT_EQ(back.prepare.surface, s.prepare.surface);
  EXPECT_EQ(back.prepare.orientation, s.prepare.orientation);
  EXPECT_EQ(back.prepare.points, s.prepare.points);
  EXPECT_EQ(back.prepare.spin_points, s.prepare.spin_points);
  EXPECT_EQ(back.prepare.neighbours, s.prepare.neighbours);
  EXPECT_EQ(back.spin.convention, s.spin.convention);
  EXPECT_EQ(back.spin.image_width, s.spin.image_width);
  EXPECT_EQ(back.spin.bin_size, s.spin.bin_size);
  EXPECT_EQ(back.spin.support_angle, s.spin.support_angle);
  EXPECT_EQ(back.bin_size_unit, s.bin_size_unit);
  EXPECT_EQ(back.encoding, s.encoding);
  EXPECT_EQ(back.radial, s.radial);
  EXPECT_EQ(back.plain_samples, s.plain_samples);
  EXPECT_EQ(back.judge.dimensions, s.judge.dimensions);
  EXPECT_EQ(back.background, s.background);
  EXPECT_EQ(back.up, s.up);
  EXPECT_EQ(back.draws, s.draws);
  EXPECT_EQ(back.trained_for, s.trained_for);
  EXPECT_EQ(back.words, s.words);
  EXPECT_EQ(back.judge.kernel, s.judge.kernel);
  EXPECT_EQ(back.judge.c, s.judge.c);
  EXPECT_EQ(back.judge.class_weights, s.judge.class_weights);
  EXPECT_EQ(back.copies, s.copies);
  EXPECT_EQ(back.views, s.views);
  EXPECT_EQ(back.stretch, s.stretch);
  EXPECT_EQ(back.seed, s.seed);
}

template <class Choice>
void expect_round_trips(Choice Settings::*field) {
  for (const auto& each : choices<Choice>()) {
    Settings s = preset("default");
    s.*field = each.choice;
    EXPECT_EQ(settings_from_json(json_of(s)).*field, each.choice) << each.name;
  }
}

TEST(SettingsJson, RoundTripsEveryChoice) {
  expect_round_trips(&Settings::bin_size_unit);
  for (const auto& each : choices<SurfaceKind>()) {
    Settings s = preset("default");
    s.prepare.surface = each.choice;
    EXPECT_EQ(settings_from_json(json_of(s)).prepare.surface, each.choice) << each.name;
  }
  for (const auto& each : choices<NormalOrientation>()) {
    Settings s = preset("default");
    s.prepare.orientation = each.choice;
    EXPECT_EQ(settings_from_json(json_of(s)).prepare.orientation, each.choice) << each.name;
  }
  for (const auto& each : choices<SpinConvention>()) {
    Settings s = preset("paper");
    s.spin.convention = each.choice;
    EXPECT_EQ(settings_from_json(json_of(s)).spin.convention, each.choice) << each.name;
  }
  for (const auto& each : choices<Binning>()) {
    Settings s = preset("default");
    s.spin.binning = each.choice;
    EXPECT_EQ(settings_from_json(json_of(s)).spin.binning, each.choice) << each.name;
  }
  for (const auto& each : choices<AngleTest>()) {
    Settings s = preset("default");
    s.spin.angle_test = each.choice;
    EXPECT_EQ(settings_from_json(json_of(s)).spin.angle_test, each.choice) << each.name;
  }
}

TEST(SettingsJson, NamesAMissingField) {
  const Json whole = json_of(preset("default"));
  EXPECT_EQ(whole.size(), 29U);
  for (const auto& [field, value] : whole.items()) {
    Json json = whole;
    json.erase(field);
    EXPECT_EQ(error_of(json), "setting '" + field + "' is missing");
  }
  EXPECT_EQ(error_of(Json::array({1, 2})), "setting 'preset' is missing");
}

TEST(SettingsJson, NamesAFieldOfTheWrongType) {
  const Json whole = json_of(preset("default"));
  for (const auto& [field, value] : whole.items()) {
    for (const Json& wrong : {Json(nullptr), Json::array({1}), Json::object(), value.is_string() ? Json(1) : Json("1"),
                              value.is_boolean() ? Json(1) : Json(true)}) {
      Json json = whole;
      json[field] = wrong;
      const std::string error = error_of(json);
      EXPECT_NE(error.find("'" + field + "' is "), std::string::npos) << field << " = " << wrong << ": " << error;
    }
  }
}

TEST(SettingsJson, DoesNotCutNumbers) {
  for (const char* field :
       {"points", "spin_points", "neighbours", "image_width", "words", "draws", "copies", "views"}) {
    const std::string expected = "setting '" + std::string(field) + "' is not a whole number in range";
    EXPECT_EQ(error_with(field, 8.5), expected);
    EXPECT_EQ(error_with(field, 8.0), expected);
    EXPECT_EQ(error_with(field, (std::int64_t{1} << 32) + 8), expected);
    EXPECT_EQ(error_with(field, std::numeric_limits<std::uint64_t>::max()), expected);
    EXPECT_EQ(error_with(field, std::numeric_limits<std::int64_t>::min()), expected);
  }
  EXPECT_EQ(error_with("seed", -1), "setting 'seed' is not a whole number in range");
  EXPECT_EQ(error_with("seed", 1e20), "setting 'seed' is not a whole number in range");
}

TEST(SettingsJson, NamesAFieldOutOfRange) {
  EXPECT_EQ(error_with("points", 0), "points 0: expected 1 to 10,000,000");
  EXPECT_EQ(error_with("spin_points", -1), "spin_points -1: expected 1 to 10,000,000");
  EXPECT_EQ(error_with("neighbours", 2), "neighbours 2: expected 3 to 1,000");
  EXPECT_EQ(error_with("image_width", 264), "image_width 264: expected 1 to 256");
  EXPECT_EQ(error_with("bin_size", 0), "bin_size 0: expected a number above 0");
  EXPECT_EQ(error_with("bin_size", std::numeric_limits<double>::infinity()), "bin_size inf: expected a number above 0");
  EXPECT_EQ(error_with("support_angle", 181), "support_angle 181: expected 0 to 180");
  EXPECT_EQ(error_with("c", std::numeric_limits<double>::quiet_NaN()), "c nan: expected a number above 0");
  EXPECT_EQ(error_with("draws", 0), "draws 0: expected 1 to 100");
  EXPECT_EQ(error_with("up", "w"), "up 'w' is not known (one of none, x, y, z)");
  EXPECT_EQ(error_with("trained_for", "scans"), "trained_for 'scans' is not known (one of meshes, any, views)");
  EXPECT_EQ(error_with("words", 1), "words 1: expected 2 to 65,536");
  EXPECT_EQ(error_with("copies", 101), "copies 101: expected 0 to 100");
  EXPECT_EQ(error_with("views", 0), "views 0: expected 1 to 1,000");
  EXPECT_EQ(error_with("stretch", 2.5), "stretch 2.5: expected 0 to 2");
  EXPECT_EQ(error_with("surface", "skin"), "surface 'skin' is not known (one of vertices, samples, external)");
  EXPECT_EQ(error_with("bin_size_unit", ""), "bin_size_unit '' is not known (one of absolute, resolution, relative)");
  EXPECT_EQ(error_with("encoding", "x"),
            "encoding 'x' is not known (one of pooled-pyramid, concatenation, mean-image, bag-of-features)");
  EXPECT_NE(error_with("image_width", 20), "no error");  // the pyramid needs a width divisible by 8
}

TEST(Presets, AreValidAndKnowTheirNames) {
  for (const std::string& name : preset_names()) {
    const Settings s = preset(name);
    EXPECT_EQ(s.preset, name);
    s.validate();
  }
  EXPECT_EQ(input_error([] { preset("best"); }), "preset 'best' is not known (one of default, paper)");
}

TEST(Presets, PaperIsAsThePaperSays) {
  const Settings s = preset("paper");
  EXPECT_EQ(s.prepare.surface, SurfaceKind::vertices);
  EXPECT_EQ(s.prepare.spin_points, 100);
  EXPECT_EQ(s.encoding, "concatenation");
  EXPECT_EQ(s.spin.binning, Binning::bilinear);
  EXPECT_EQ(s.copies, 0);
}

TEST(SettingNames, NameEachChoiceOnce) {
  EXPECT_EQ(name_of(SurfaceKind::external), "external");
  EXPECT_EQ(choice_of<AngleTest>("angle", "soft"), AngleTest::soft);
  EXPECT_EQ(input_error([] { choice_of<Binning>("binning", "Nearest"); }),
            "binning 'Nearest' is not known (one of bilinear, nearest)");
}

}  // namespace
}  // namespace spincat
