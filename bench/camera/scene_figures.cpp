#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "figures.h"
#include "scenes.h"
#include "spincat/camera/render/sensor_noise.h"
#include "spincat/classify/recogniser.h"
#include "spincat/dataset/splits.h"
#include "spincat/evaluate/rates.h"
#include "spincat/train/train.h"

namespace spincat::bench {
namespace {

constexpr int kFolds = 5;
constexpr int kFrames = 8;
constexpr double kStep = 3.0;              // degrees that the camera goes around from frame to frame
constexpr std::size_t kLeastPixels = 300;  // of a thing that must be found

struct Counts {
  int frames = 0;
  int right_planes = 0;
  int things = 0;  // that show enough, in first frames
  int found = 0;
  int false_objects = 0;  // in all frames
  Confusion one_frame;
  Confusion fused;
};

bool is_right_plane(const SeenFrame& frame, const SupportPlane& truth) {
  constexpr float kCosine = 0.9986F;  // 3 degrees
  return frame.table && frame.table->normal.dot(truth.normal) > kCosine &&
         std::abs(frame.table->offset - truth.offset) < 0.02F;
}

// For each object of the frame: the thing it is (intersection over union of a half or more), 0 for none.
std::vector<std::uint16_t> things_of(const SeenFrame& frame, const std::vector<std::uint16_t>& truth, Counts& counts) {
  std::map<std::uint16_t, double> size;
  std::map<std::pair<std::uint16_t, std::uint16_t>, double> both;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    size[truth[i]] += 1.0;
    if (!frame.segmentation.ids.empty()) {
      both[{frame.segmentation.ids[i], truth[i]}] += 1.0;
    }
  }
  std::vector<std::uint16_t> things(frame.objects.size(), 0);
  for (std::size_t k = 0; k < things.size(); ++k) {
    const Segment& segment = frame.objects[k].segment;
    double on_things = 0.0;
    for (const auto& [thing, pixels] : size) {
      const double shared = both[{segment.id, thing}];
      on_things += thing > 0 ? shared : 0.0;
      if (thing > 0 && shared / (pixels + static_cast<double>(segment.pixels) - shared) >= 0.5) {
        things[k] = thing;
      }
    }
    counts.false_objects += on_things < 0.5 * static_cast<double>(segment.pixels) ? 1 : 0;
  }
  return things;
}

// Eight frames of one scene, by one recogniser.
void play(const MadeScene& made, const Model& model, Random& random, Counts& counts) {
  Recogniser recogniser(model, {}, 1);
  for (int k = 0; k < kFrames; ++k) {
    const SceneView view = made.frame(k * kStep);
    DepthImage image = view.image;
    add_sensor_noise(Intrinsics{}, 1.0, random, image);
    const SeenFrame frame = recogniser.look(image, Intrinsics{});
    ++counts.frames;
    counts.right_planes += is_right_plane(frame, view.table) ? 1 : 0;
    const std::vector<std::uint16_t> things = things_of(frame, view.things, counts);
    if (k == 0) {
      for (std::size_t t = 1; t <= made.categories.size(); ++t) {
        if (std::ranges::count(view.things, t) >= static_cast<std::ptrdiff_t>(kLeastPixels)) {
          ++counts.things;
          counts.found += std::ranges::find(things, t) != things.end() ? 1 : 0;
        }
      }
    }
    for (std::size_t i = 0; i < things.size(); ++i) {
      const SeenObject& object = frame.objects[i];
      if (things[i] == 0 || !object.problem.empty()) {
        continue;
      }
      const std::uint32_t category = made.categories[things[i] - 1];
      if (k == 0) {
        ++counts.one_frame[category][object.ballot.winner];
      } else if (k == kFrames - 1) {
        ++counts.fused[category][object.fused.winner];
      }
    }
  }
}

}  // namespace

Json scene_figures(const Dataset& objects, const SceneOptions& options) {
  const std::size_t n = objects.categories.size();
  Counts counts;
  counts.one_frame.assign(n, std::vector<std::uint32_t>(n, 0));
  counts.fused = counts.one_frame;
  Random random(options.seed);
  for (const Split& fold : stratified_folds(labels_of(objects), kFolds, options.seed)) {
    const Model model = views_model(part_of(objects, fold.train), options);
    const SceneMaker maker(part_of(objects, fold.test), options.up);
    for (int s = 0; s < options.scenes; ++s) {
      play(maker.make(1 + random.below(4), random), model, random, counts);
    }
  }
  const auto share = [](int part, int all) { return static_cast<double>(part) / std::max(all, 1); };
  return {{"frames", counts.frames},
          {"right_planes", share(counts.right_planes, counts.frames)},
          {"false_objects_a_frame", share(counts.false_objects, counts.frames)},
          {"things", counts.things},
          {"found", share(counts.found, counts.things)},
          {"mean_class_rate_one_frame", mean_class_rate(counts.one_frame)},
          {"overall_rate_one_frame", overall_rate(counts.one_frame)},
          {"mean_class_rate_eight_frames", mean_class_rate(counts.fused)},
          {"overall_rate_eight_frames", overall_rate(counts.fused)},
          {"confusion_one_frame", counts.one_frame}};
}

}  // namespace spincat::bench
