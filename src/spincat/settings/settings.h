// The settings of the whole road from an object to a name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/judge/settings.h"
#include "spincat/prepare/prepare.h"
#include "spincat/range.h"
#include "spincat/spin/params.h"

#pragma GCC visibility push(default)
namespace spincat {

// The unit in which a bin size is given.
enum class BinSizeUnit {
  absolute,    // the unit of the object's file
  resolution,  // mesh resolutions (Johnson)
  relative,    // the object's radius: the distance of its furthest point from the centre of its bounding box
};

// What the judges are trained for.
enum class TrainedFor {
  meshes,  // objects as the training files hold them
  any,     // point clouds as well: each training object is shown as an exact and as a noisy cloud besides
  views,   // what a depth camera sees: each training object is shown as rendered views (camera/render/views.h) alone
};

// Everything that decides about the result, and nothing else (no threads, no file names). A model keeps a copy, so that
// classifying repeats exactly what training did.
struct Settings {
  std::string preset = "default";
  PrepareSettings prepare;
  SpinImageParams spin;  // spin.bin_size in the unit below
  BinSizeUnit bin_size_unit = BinSizeUnit::relative;
  std::string encoding = "pooled-pyramid";
  // The feature vector is made of parts, joined and scaled to length 1: the encoding of the spin images of the points
  // that prepare.surface says, and those that are switched on here.
  bool plain_samples = false;  // the same of points drawn evenly from all faces, hidden ones too
  bool radial = false;         // the same points with spin images whose axes point away from the mean of the surface
                               // points, instead of along the normals
  UpAxis up = UpAxis::none;    // the same with spin images whose axes all point up, instead of along the normals; with
                               // views the axis of the models (clouds are upright: z), and not none
  int draws = 1;               // every part is the mean over so many draws of points
  int words = 256;             // of the codebook that the bag-of-features encoding learns
  JudgeSettings judge;
  int copies = 6;                               // stretched copies of each training object
  TrainedFor trained_for = TrainedFor::meshes;  // any: besides, kClouds stretched copies turned into clouds
  int views = 12;                               // of each training object where trained_for says so
  int background = 0;                           // shapes of no category that strangers are told by, besides the
                                                // others that a data set has; it takes a small space (judge.dimensions)
  double stretch = 0.2;                         // each axis of a copy is stretched by exp(U(-stretch, stretch))
  std::uint64_t seed = 1;                       // of every random choice

  static constexpr int kClouds = 3;

  static constexpr Range kDraws{1, 100};
  static constexpr Range kWords{2, 65'536};
  static constexpr Range kCopies{0, 100};
  static constexpr Range kViews{1, 1'000};
  static constexpr Range kStretch{0.0, 2.0};
  static constexpr Range kBackground{0, 536};  // so many shapes there are

  // How many parts a feature vector has, all of one length.
  int parts() const { return 1 + (radial ? 1 : 0) + (plain_samples ? 1 : 0) + (up != UpAxis::none ? 1 : 0); }

  // How many feature vectors a training object gives: its own and its copies', or its views'.
  int training_rows() const {
    return trained_for == TrainedFor::views ? views : 1 + copies + (trained_for == TrainedFor::any ? kClouds : 0);
  }

  // How many of them show the object as it may be met, the first ones: itself alone, or all views.
  int tested_rows() const { return trained_for == TrainedFor::views ? views : 1; }

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
  // Throws InputError where an object would take more points and spin points, over all draws, than kMostForJudges: a
  // model file that somebody else made must not keep its user busy for hours.
  void validate_for_judges() const;
  static constexpr std::int64_t kMostForJudges = 4'000'000;
};

// Named settings: "default" (the best we know; docs/how-it-works/encoding.md) and "paper" (as the paper describes it:
// 100 random vertices, bilinear images of 20 x 20, concatenated). Throws InputError that lists the names when there is
// none.
Settings preset(std::string_view name);
const std::vector<std::string>& preset_names();

// The settings changed to what suits judges that will look through a depth camera (docs/guide/camera.md), trained by so
// many views of each object.
Settings trained_by_views(Settings settings, int views);

}  // namespace spincat
#pragma GCC visibility pop
