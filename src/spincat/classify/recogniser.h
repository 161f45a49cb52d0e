// From depth frames to names: the table, the objects on it, a vote on each, and its votes summed while it is followed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spincat/camera/segment/scene.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/classify/model.h"
#include "spincat/judge/ballot.h"

#pragma GCC visibility push(default)
namespace spincat {

struct RecogniserSettings {
  TableSettings table;
  SegmentSettings segment;
  TrackSettings tracks;
  std::optional<double> reject;  // names of objects that are less known are not given, 0 to 1; none: the model's choice
  int summed_frames = 30;        // of a track: over so many of its last ones votes are summed, 1 to 10,000

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

// What came of a frame as a whole.
enum class FrameStatus {
  objects,       // there are some
  empty_table,   // a table, and nothing on it
  no_table,      // no plane holds enough of the readings
  few_readings,  // hardly a pixel has a depth
  wrong_units,   // most readings, or the table, are nearer or further than such cameras see
};

// One object of a frame.
struct SeenObject {
  std::uint64_t id = 0;           // the same from frame to frame, counted from 1
  Segment segment;                // its place in this frame
  float distance = 0.0F;          // from the camera to its middle, in metres
  std::string problem;            // why it could not be named; empty where it could, and only then what follows holds
  Ballot ballot;                  // of this frame
  double confidence = 0.0;        // of this frame
  double known = 1.0;             // of this frame: how likely it is of one of the categories
  SummedVotes fused;              // over its last frames
  double fused_confidence = 0.0;  // the mean over these frames of the confidence in fused.winner, 0 where they named it
                                  // otherwise
  double fused_known = 1.0;       // the mean over its last frames of how known it is
  bool unknown = false;           // fused_known is below RecogniserSettings::reject
};

// Seconds of one frame, by stage.
struct FrameSeconds {
  double table = 0.0;
  double segment = 0.0;
  double name = 0.0;  // describing and voting, all objects
  double all() const { return table + segment + name; }
};

struct SeenFrame {
  FrameStatus status = FrameStatus::few_readings;
  double median_depth = 0.0;  // of the readings, in metres; 0 where there are none
  std::optional<SupportPlane> table;
  Segmentation segmentation;        // ids has no pixels where there is no table, or too far a one
  std::vector<SeenObject> objects;  // in the order of segmentation.objects
  FrameSeconds seconds;
};

// Looks at one frame after the other. What it says depends on the frames so far, and neither on the number of threads
// nor on the clock.
class Recogniser {
 public:
  // Throws InputError when the settings are out of range.
  Recogniser(const Model& model, const RecogniserSettings& settings, int threads);
  ~Recogniser();

  // Objects of a frame are named on several threads. Memory does not grow with the number of frames. Depths that are
  // negative, no numbers, less than a millimetre or more than a million metres count as not read.
  SeenFrame look(const DepthImage& image, const Intrinsics& intrinsics);

 private:
  class Sight;
  std::unique_ptr<Sight> sight_;
};

}  // namespace spincat
#pragma GCC visibility pop
