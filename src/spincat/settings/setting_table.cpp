#include "spincat/settings/setting_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/error.h"
#include "spincat/settings/setting_names.h"

namespace spincat {
namespace {

using enum SettingStage;

bool counts_words(const Settings& s) {
  return make_encoding(s.encoding)->gives_local_features();
}

std::string needs_drawn_points(const Settings& s) {
  const bool draws =
      s.prepare.surface != SurfaceKind::vertices || s.plain_samples || s.trained_for != TrainedFor::meshes;
  return draws ? "" : "all vertices are taken with surface vertices";
}

std::string needs_cutoff(const Settings& s) {
  return s.spin.angle_test == AngleTest::cutoff ? "" : "no angle is left out with angle_test soft";
}

std::string needs_words(const Settings& s) {
  return counts_words(s) ? "" : fmt::format("the encoding {} learns no codebook", s.encoding);
}

std::string is_not_by_views(const Settings& s) {
  return s.trained_for == TrainedFor::views ? "judges that learn by views are shown no copies" : "";
}

std::string needs_copies(const Settings& s) {
  return s.trained_for == TrainedFor::meshes && s.copies == 0 ? "there are no copies (copies is 0)"
                                                              : is_not_by_views(s);
}

std::string needs_dimensions(const Settings& s) {
  return s.judge.dimensions > 0 ? "" : "strangers are told in the small space of judges alone (dimensions is 0)";
}

std::string needs_views(const Settings& s) {
  return s.trained_for == TrainedFor::views
             ? ""
             : fmt::format("judges that are trained for {} see no views", name_of(s.trained_for));
}

// Local features cannot be joined with others. Features in a random order have no small space.
void bring_encoding(Settings& s) {
  if (counts_words(s)) {
    s.radial = false;
    s.plain_samples = false;
    s.draws = 1;
  }
  if (counts_words(s) || !make_encoding(s.encoding)->pools()) {
    s.judge.dimensions = 0;
    s.judge.c = default_c(s.judge);
  }
}

void bring_kernel(Settings& s) {
  if (s.judge.kernel == KernelKind::rbf) {
    s.judge.dimensions = 0;
  }
  s.judge.c = default_c(s.judge);
}

void bring_dimensions(Settings& s) {
  s.judge.c = default_c(s.judge);
}

void bring_views(Settings& s) {
  s = trained_by_views(s, s.views);
}

void bring_trained_for(Settings& s) {
  if (s.trained_for == TrainedFor::views) {
    bring_views(s);
  }
}

// Asking for an angle means the hard one.
void bring_support_angle(Settings& s) {
  s.spin.angle_test = AngleTest::cutoff;
}

constexpr Range kNone{};

// clang-format off
const Setting kTable[] = {
    {"surface", "surface", "KIND", "Points that stand for a mesh", points, kNone,
     [](Settings& s) -> SettingMember { return &s.prepare.surface; }},
    {"orientation", "orientation", "KIND", "Sign of the normals where nothing else tells it", points, kNone,
     [](Settings& s) -> SettingMember { return &s.prepare.orientation; }},
    {"points", "points", "N", "Surface points of an object", points, PrepareSettings::kPoints,
     [](Settings& s) -> SettingMember { return &s.prepare.points; }, needs_drawn_points},
    {"spin_points", "spin-points", "N", "Spin points (and images) of an object, chosen at random", points,
     PrepareSettings::kSpinPoints, [](Settings& s) -> SettingMember { return &s.prepare.spin_points; }},
    {"neighbours", "neighbours", "N", "Neighbours of a cloud's point that give its normal", points,
     PrepareSettings::kNeighbours, [](Settings& s) -> SettingMember { return &s.prepare.neighbours; }},
    {"convention", "convention", "NAME", "Whose definition of a spin image", images, kNone,
     [](Settings& s) -> SettingMember { return &s.spin.convention; }},
    {"image_width", "image-width", "N", "Rows and columns of a spin image", images, SpinImageParams::kImageWidth,
     [](Settings& s) -> SettingMember { return &s.spin.image_width; }},
    {"bin_size", "bin-size", "SIZE",
     "Size of a bin; behind the number rel (object radii), res (mesh resolutions) or abs (the file's unit) may stand",
     images, SpinImageParams::kBinSize, [](Settings& s) -> SettingMember { return &s.spin.bin_size; }},
    {"bin_size_unit", "bin-size-unit", "UNIT", "Unit of the bin size", images, kNone,
     [](Settings& s) -> SettingMember { return &s.bin_size_unit; }},
    {"support_angle", "support-angle", "DEGREES",
     "Largest angle between the normals of a spin point and of a point that counts; brings --angle-test cutoff", images,
     SpinImageParams::kSupportAngle, [](Settings& s) -> SettingMember { return &s.spin.support_angle; }, needs_cutoff,
     bring_support_angle},
    {"binning", "binning", "KIND", "Share of a point among the cells around it", images, kNone,
     [](Settings& s) -> SettingMember { return &s.spin.binning; }},
    {"angle_test", "angle-test", "KIND", "What the angle between normals does to a point: leave it out, or weigh it", images,
     kNone, [](Settings& s) -> SettingMember { return &s.spin.angle_test; }},
    {"encoding", "encoding", "NAME", "Way from spin images to a feature vector", features, kNone,
     [](Settings& s) -> SettingMember { return &s.encoding; }, nullptr, bring_encoding},
    {"radial", "radial", "BOOL", "Add features of spin images whose axes point away from the object's middle", features,
     kNone, [](Settings& s) -> SettingMember { return &s.radial; }},
    {"plain_samples", "plain-samples", "BOOL", "Add features of points drawn evenly from all faces, hidden ones too",
     features, kNone, [](Settings& s) -> SettingMember { return &s.plain_samples; }},
    {"up", "up", "AXIS", "Axis that points up in all objects: adds features of spin images whose axes point up",
     features, kNone, [](Settings& s) -> SettingMember { return &s.up; }},
    {"draws", "draws", "N", "Draws of points that a feature vector is the mean of", features, Settings::kDraws,
     [](Settings& s) -> SettingMember { return &s.draws; }},
    {"words", "words", "N", "Words of the codebook that bag-of-features learns", training, Settings::kWords,
     [](Settings& s) -> SettingMember { return &s.words; }, needs_words},
    {"kernel", "kernel", "NAME", "Kernel of the judges' SVMs; rbf is over the encoding's blocks, and brings its C",
     training, kNone, [](Settings& s) -> SettingMember { return &s.judge.kernel; }, nullptr, bring_kernel},
    {"dimensions", "dimensions", "N",
     "Dimensions of the small space that judges learn in (within-class whitening); 0: none; brings their C", training,
     JudgeSettings::kDimensions, [](Settings& s) -> SettingMember { return &s.judge.dimensions; }, nullptr,
     bring_dimensions},
    {"c", "c", "C", "C of the judges' SVMs: the price of an error in training", training, JudgeSettings::kC,
     [](Settings& s) -> SettingMember { return &s.judge.c; }},
    {"class_weights", "class-weights", "BOOL", "Weigh errors so that a large category does not outvote a small one",
     training, kNone, [](Settings& s) -> SettingMember { return &s.judge.class_weights; }},
    {"copies", "copies", "N", "Stretched copies of each training object", training, Settings::kCopies,
     [](Settings& s) -> SettingMember { return &s.copies; }, is_not_by_views},
    {"trained_for", "for", "KIND",
     "What the model will name; meshes: no point clouds, views: what a camera sees",
     training, kNone, [](Settings& s) -> SettingMember { return &s.trained_for; }, nullptr, bring_trained_for},
    {"views", "views", "N",
     "Learn what a depth camera sees, by so many rendered views of each object (30: better, takes longer); brings "
     "--up y and fewer, smaller images",
     training, Settings::kViews, [](Settings& s) -> SettingMember { return &s.views; }, needs_views, bring_views},
    {"background", "background", "N",
     "Shapes of no category that strangers are told by; 0: none, every object gets a name", training,
     Settings::kBackground, [](Settings& s) -> SettingMember { return &s.background; }, needs_dimensions},
    {"stretch", "stretch", "AMOUNT", "How far copies are stretched: each axis by exp(U(-AMOUNT, AMOUNT))", training,
     Settings::kStretch, [](Settings& s) -> SettingMember { return &s.stretch; }, needs_copies},
    {"seed", "seed", "N", "Seed of every random choice", points, kNone,
     [](Settings& s) -> SettingMember { return &s.seed; }},
};
// clang-format on

}  // namespace

std::span<const Setting> setting_table() {
  return kTable;
}

const Setting& find_setting(std::string_view name) {
  if (!is_setting_text(name)) {
    throw InputError("a setting's name is too long or not printable");
  }
  std::string key(name.substr(name.rfind('.') == std::string_view::npos ? 0 : name.rfind('.') + 1));
  std::ranges::replace(key, '-', '_');
  const auto* const found = std::ranges::find(kTable, key, &Setting::name);
  if (found == std::end(kTable)) {
    std::vector<std::string_view> names;
    std::ranges::transform(kTable, std::back_inserter(names), &Setting::name);
    throw InputError(fmt::format("setting '{}' is not known (one of {})", name, fmt::join(names, ", ")));
  }
  return *found;
}

}  // namespace spincat
