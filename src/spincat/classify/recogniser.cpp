#include "spincat/classify/recogniser.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include "spincat/camera/segment/segment.h"
#include "spincat/camera/segment/segment_cloud.h"
#include "spincat/camera/segment/table.h"
#include "spincat/camera/segment/tracks.h"
#include "spincat/classify/classify.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/error.h"
#include "spincat/parallel/for_each.h"

namespace spincat {
namespace {

// What depth cameras see, generously.
constexpr double kNearest = 0.1;  // metres
constexpr double kFurthest = 20.0;
constexpr float kFurthestTable = 3.5F;  // on which such a camera tells objects apart

constexpr int kStride = 4;                 // every fourth pixel both ways is looked at
constexpr std::size_t kFewReadings = 300;  // of these

constexpr float kLeastDepth = 1e-3F;  // metres: what is less, more than the most, or no number, is no reading
constexpr float kMostDepth = 1e6F;

bool is_sound(float depth) {
  return depth == 0.0F || (depth >= kLeastDepth && depth <= kMostDepth);
}

struct Readings {
  std::size_t count = 0;
  double median = 0.0;  // depth
};

Readings readings_of(const DepthImage& image) {
  std::vector<float> readings;
  for (int v = 0; v < image.height; v += kStride) {
    for (int u = 0; u < image.width; u += kStride) {
      if (image.at(u, v) > 0.0F) {
        readings.push_back(image.at(u, v));
      }
    }
  }
  if (readings.empty()) {
    return {};
  }
  const auto middle = readings.begin() + static_cast<std::ptrdiff_t>(readings.size() / 2);
  std::ranges::nth_element(readings, middle);
  return {readings.size(), static_cast<double>(*middle)};
}

}  // namespace

void RecogniserSettings::validate() const {
  segment.validate();
  if (table.up && !(table.up->allFinite() && table.up->norm() > 0.0F)) {
    throw InputError("the direction that is up has no direction");
  }
  if (reject && !(*reject >= 0.0 && *reject <= 1.0)) {
    throw InputError(fmt::format("least share of known {} is out of range (0 to 1)", *reject));
  }
  if (summed_frames < 1 || summed_frames > 10'000) {
    throw InputError(fmt::format("number of summed frames {} is out of range (1 to 10000)", summed_frames));
  }
}

// What a recogniser knows from frame to frame.
class Recogniser::Sight {
 public:
  Sight(Model model, const RecogniserSettings& settings, int threads)
      : model_(std::move(model)), settings_(settings), threads_(threads), tracks_(settings.tracks) {}

  SeenFrame look_at(const DepthImage& image, const Intrinsics& intrinsics);

 private:
  // What is kept of an object.
  struct Memory {
    std::vector<Ballot> ballots;  // of its last frames
    std::vector<double> confidences;
    std::vector<double> known;
  };

  void find_objects(const DepthImage& image, const Intrinsics& intrinsics, SeenFrame& frame);
  void name_object(const DepthImage& image, const Intrinsics& intrinsics, const SeenFrame& frame,
                   SeenObject& object) const;
  void sum_up(SeenObject& object);

  Model model_;
  RecogniserSettings settings_;
  int threads_;
  std::optional<SupportPlane> table_;
  Tracks tracks_;
  std::map<std::uint64_t, Memory> memory_;  // by track
};

Recogniser::Recogniser(const Model& model, const RecogniserSettings& settings, int threads) {
  settings.validate();
  sight_ = std::make_unique<Sight>(model, settings, threads);
}

Recogniser::~Recogniser() = default;

SeenFrame Recogniser::look(const DepthImage& image, const Intrinsics& intrinsics) {
  if (std::ranges::all_of(image.depth, is_sound)) {
    return sight_->look_at(image, intrinsics);
  }
  DepthImage sound = image;
  std::ranges::replace_if(sound.depth, std::not_fn(is_sound), 0.0F);
  return sight_->look_at(sound, intrinsics);
}

SeenFrame Recogniser::Sight::look_at(const DepthImage& image, const Intrinsics& intrinsics) {
  SeenFrame frame;
  Stopwatch watch;
  const Readings readings = readings_of(image);
  frame.median_depth = readings.median;
  if (readings.count < kFewReadings) {
    frame.status = FrameStatus::few_readings;
  } else if (readings.median < kNearest || readings.median > kFurthest) {
    frame.status = FrameStatus::wrong_units;
  } else {
    frame.table = find_table(image, intrinsics, settings_.table, table_);
    frame.status = !frame.table                           ? FrameStatus::no_table
                   : frame.table->offset > kFurthestTable ? FrameStatus::wrong_units
                                                          : FrameStatus::empty_table;
  }
  table_ = frame.table;
  frame.seconds.table = watch.lap();
  if (frame.status == FrameStatus::empty_table) {
    frame.segmentation = segment(image, intrinsics, *frame.table, settings_.segment);
    frame.seconds.segment = watch.lap();
  }
  find_objects(image, intrinsics, frame);
  frame.seconds.name = watch.lap();
  return frame;
}

void Recogniser::Sight::find_objects(const DepthImage& image, const Intrinsics& intrinsics, SeenFrame& frame) {
  const std::vector<Segment>& found = frame.segmentation.objects;
  std::vector<Eigen::Vector3f> centres;
  for (const Segment& segment : found) {
    centres.push_back(segment.centre);
  }
  const std::vector<std::uint64_t> ids = tracks_.follow(centres);
  for (const std::uint64_t id : tracks_.forgotten()) {
    memory_.erase(id);
  }
  frame.objects.resize(found.size());
  if (!found.empty()) {
    frame.status = FrameStatus::objects;
  }
  for_each_index(found.size(), threads_, [&](std::size_t i) {
    frame.objects[i].id = ids[i];
    frame.objects[i].segment = found[i];
    name_object(image, intrinsics, frame, frame.objects[i]);
  });
  for (SeenObject& object : frame.objects) {
    if (object.problem.empty()) {
      sum_up(object);
    }
  }
}

void Recogniser::Sight::name_object(const DepthImage& image, const Intrinsics& intrinsics, const SeenFrame& frame,
                                    SeenObject& object) const {
  object.distance = object.segment.centre.norm();
  try {
    const PointCloud cloud = segment_cloud(image, intrinsics, *frame.table, frame.segmentation, object.segment);
    Classification named = classify(model_, cloud);
    object.ballot = std::move(named.ballot);
    object.confidence = named.confidence;
    object.known = named.known;
  } catch (const InputError& error) {
    object.problem = error.problem();
  }
}

void Recogniser::Sight::sum_up(SeenObject& object) {
  Memory& memory = memory_[object.id];
  const auto most = static_cast<std::size_t>(settings_.summed_frames);
  if (memory.ballots.size() == most) {
    memory.ballots.erase(memory.ballots.begin());
    memory.confidences.erase(memory.confidences.begin());
    memory.known.erase(memory.known.begin());
  }
  memory.ballots.push_back(object.ballot);
  memory.confidences.push_back(object.confidence);
  memory.known.push_back(object.known);
  object.fused = sum_votes(memory.ballots);
  double sum = 0.0;
  for (std::size_t i = 0; i < memory.ballots.size(); ++i) {
    sum += memory.ballots[i].winner == object.fused.winner ? memory.confidences[i] : 0.0;
  }
  object.fused_confidence = sum / static_cast<double>(memory.ballots.size());
  object.fused_known =
      std::accumulate(memory.known.begin(), memory.known.end(), 0.0) / static_cast<double>(memory.known.size());
  object.unknown = object.fused_known < settings_.reject.value_or(model_.least_known());
}

}  // namespace spincat
