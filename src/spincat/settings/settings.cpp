#include "spincat/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "spincat/background/background_shapes.h"
#include "spincat/encode/encoding.h"
#include "spincat/error.h"

namespace spincat {
namespace {

static_assert(Settings::kBackground.high == kBackgroundShapes);

Settings default_preset() {
  Settings s;
  s.spin.image_width = 40;
  s.spin.bin_size = 0.05;
  s.spin.support_angle = 180.0;
  s.spin.binning = Binning::nearest;
  s.spin.angle_test = AngleTest::soft;
  s.radial = true;
  s.plain_samples = true;
  s.trained_for = TrainedFor::any;
  s.background = kBackgroundShapes;
  s.judge.dimensions = 200;
  s.judge.c = default_c(s.judge);
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
  check_range("draws", draws, kDraws);
  check_range("words", words, kWords);
  check_range("copies", copies, kCopies);
  check_range("views", views, kViews);
  check_range("stretch", stretch, kStretch);
  check_range("background", background, kBackground);
  if (checked->gives_local_features() && (radial || plain_samples || up != UpAxis::none || draws > 1)) {
    throw InputError(
        fmt::format("the encoding {} knows no radial part, no plain samples, no up axis and only one draw", encoding));
  }
  if (checked->gives_local_features() && judge.dimensions > 0) {
    throw InputError(fmt::format("the encoding {} learns a codebook instead of a small space (dimensions)", encoding));
  }
  if (trained_for == TrainedFor::views && up == UpAxis::none) {
    throw InputError("views of models need to know which axis points up (x, y or z)");
  }
}

void Settings::validate_for_judges() const {
  const std::int64_t points = (std::int64_t{prepare.points} + prepare.spin_points) * draws;
  if (points > kMostForJudges) {
    throw InputError(fmt::format("{} points and spin points over all draws: judges take at most {} of an object",
                                 points, kMostForJudges));
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
  settings.radial = false;
  settings.plain_samples = false;  // nothing of a view is hidden
  settings.copies = 0;
  // More points, images and bins bring nothing here, and cost time with each frame (docs/guide/camera.md).
  settings.spin.image_width = 24;
  settings.prepare.points = 1024;
  settings.prepare.spin_points = 128;
  return settings;
}

}  // namespace spincat
