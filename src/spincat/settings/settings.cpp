#include "spincat/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "spincat/encode/encoding.h"
#include "spincat/error.h"

namespace spincat {
namespace {

Settings default_preset() {
  Settings s;
  s.spin.image_width = 40;
  s.spin.bin_size = 0.05;
  s.spin.support_angle = 180.0;
  s.spin.binning = Binning::nearest;
  s.spin.angle_test = AngleTest::soft;
  s.plain_samples = true;
  return s;
}

Settings paper_preset() {
  Settings s;
  s.preset = "paper";
  s.prepare.surface = SurfaceKind::vertices;
  s.prepare.orientation = NormalOrientation::as_given;
  s.prepare.spin_points = 100;
  s.spin.image_width = 20;
  s.spin.bin_size = 0.1;
  s.spin.support_angle = 60.0;
  s.encoding = "concatenation";
  s.judge.class_weights = false;
  s.copies = 0;
  return s;
}

}  // namespace

void Settings::validate() const {
  prepare.validate();
  spin.validate();
  judge.validate();
  const std::unique_ptr<Encoding> checked = make_encoding(encoding);
  checked->check(spin);
  if (draws < 1 || draws > 100) {
    throw InputError(fmt::format("number of draws {} is out of range (1 to 100)", draws));
  }
  if (checked->gives_local_features() && (plain_samples || up != UpAxis::none || draws > 1)) {
    throw InputError(fmt::format("the encoding {} knows no plain samples, no up axis and only one draw", encoding));
  }
  if (words < 2 || words > 65'536) {
    throw InputError(fmt::format("number of words {} is out of range (2 to 65536)", words));
  }
  if (copies < 0 || copies > 100) {
    throw InputError(fmt::format("number of copies {} is out of range (0 to 100)", copies));
  }
  if (views < 1 || views > 1'000) {
    throw InputError(fmt::format("number of views {} is out of range (1 to 1000)", views));
  }
  if (trained_for == TrainedFor::views && up == UpAxis::none) {
    throw InputError("views of models need to know which axis points up (x, y or z)");
  }
  if (!(stretch >= 0.0 && stretch <= 2.0)) {
    throw InputError(fmt::format("stretch {} is out of range (0 to 2)", stretch));
  }
}

Settings preset(std::string_view name) {
  if (name == "default") {
    return default_preset();
  }
  if (name == "paper") {
    return paper_preset();
  }
  throw InputError(fmt::format("preset '{}' is not known (one of {})", name, fmt::join(preset_names(), ", ")));
}

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names = {"default", "paper"};
  return names;
}

Settings trained_by_views(Settings settings, int views) {
  settings.trained_for = TrainedFor::views;
  settings.views = views;
  settings.up = UpAxis::y;
  settings.plain_samples = false;  // nothing of a view is hidden
  settings.copies = 0;
  // More points, images and bins bring nothing here, and cost time with each frame (docs/camera.md).
  settings.spin.image_width = 24;
  settings.prepare.points = 1024;
  settings.prepare.spin_points = 128;
  return settings;
}

}  // namespace spincat
