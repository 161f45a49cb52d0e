#include <algorithm>

#include "figures.h"
#include "scenes.h"
#include "spincat/camera/render/sensor_noise.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/classify/recogniser.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/report/time_histogram.h"

namespace spincat::bench {
namespace {

// Frames of scenes in which all of so many things are found.
std::vector<DepthImage> frames_with(std::size_t things, const SceneMaker& maker, const Model& model) {
  constexpr std::size_t kFrames = 64;
  constexpr int kEachScene = 8;
  std::vector<DepthImage> frames;
  Random random(5);
  while (frames.size() < kFrames) {
    const MadeScene made = maker.make(things, random);
    Recogniser recogniser(model, {}, 1);
    for (int k = 0; k < kEachScene; ++k) {
      DepthImage image = made.frame(2.0 * k).image;
      add_sensor_noise(Intrinsics{}, 1.0, random, image);
      if (recogniser.look(image, Intrinsics{}).objects.size() == things) {
        frames.push_back(std::move(image));
      }
    }
  }
  return frames;
}

Json timed(const std::vector<DepthImage>& frames, const Model& model, int threads, double seconds) {
  Recogniser recogniser(model, {}, threads);
  for (const DepthImage& frame : frames) {  // memory becomes warm
    recogniser.look(frame, Intrinsics{});
  }
  TimeHistogram all;
  TimeHistogram table;
  TimeHistogram segment;
  TimeHistogram name;
  Stopwatch watch;
  for (double passed = 0.0; passed < seconds; passed += watch.lap()) {
    for (const DepthImage& frame : frames) {
      const SeenFrame seen = recogniser.look(frame, Intrinsics{});
      all.add(seen.seconds.all());
      table.add(seen.seconds.table);
      segment.add(seen.seconds.segment);
      name.add(seen.seconds.name);
    }
  }
  return {{"threads", threads},
          {"frames", all.count()},
          {"frames_a_second", 1.0 / all.mean()},
          {"p50_ms", 1e3 * all.percentile(0.5)},
          {"p95_ms", 1e3 * all.percentile(0.95)},
          {"p99_ms", 1e3 * all.percentile(0.99)},
          {"table_ms", 1e3 * table.percentile(0.5)},
          {"segment_ms", 1e3 * segment.percentile(0.5)},
          {"name_ms", 1e3 * name.percentile(0.5)}};
}

double decode_milliseconds(const std::vector<DepthImage>& frames) {
  TimeHistogram times;
  for (const DepthImage& frame : frames) {
    const std::string bytes = encode_depth_png(frame, 1000.0);
    Stopwatch watch;
    const DepthImage back = decode_depth_png(bytes, 1000.0);
    times.add(watch.lap());
  }
  return 1e3 * times.percentile(0.5);
}

}  // namespace

Json speed_figures(const Dataset& objects, const SceneOptions& options, double seconds) {
  const Model model = views_model(objects, options);
  const SceneMaker maker(objects, options.up);
  Json table = Json::array();
  double decode = 0.0;
  for (const std::size_t things : {1U, 3U, 6U}) {
    const std::vector<DepthImage> frames = frames_with(things, maker, model);
    for (const int threads : {1, 2}) {
      Json row = {{"objects", things}};
      row.update(timed(frames, model, threads, seconds));
      table.push_back(row);
    }
    decode = decode_milliseconds(frames);
  }
  return {{"table", table}, {"png_decoding_ms", decode}};
}

}  // namespace spincat::bench
