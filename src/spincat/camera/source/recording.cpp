// Recordings: files of depth frames.
#include <fmt/format.h>

#include <new>
#include <utility>
#include <vector>

#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/cloud_frame.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/camera/source/recording_files.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/io/organized_cloud.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

constexpr double kUnitsOfTum = 5'000.0;

class Recording : public FrameSource {
 public:
  Recording(RecordingFiles files, const CameraCalibration& calibration, const FrameSettings& settings)
      : folder_(std::move(files.folder)),
        frames_(std::move(files.frames)),
        notes_(std::move(files.notes)),
        is_one_file_(files.is_one_file),
        calibration_(calibration),
        limits_(settings.limits),
        loop_(settings.loop) {}

  std::optional<Frame> next() override {
    if (at_ == frames_.size() && !loop_) {
      return {};
    }
    const ListedFrame& listed = frames_[at_ % frames_.size()];
    const std::size_t round = at_++ / frames_.size();
    const fs::path file = folder_ / listed.file;
    try {
      Frame frame = naming_file(file, [&] { return read(file); });
      frame.name = file.filename().string();
      // Not 0 * length(): a list may name times so far apart that it is infinite.
      frame.time = listed.time + (round > 0 ? static_cast<double>(round) * length() : 0.0);
      return frame;
    } catch (const std::bad_alloc&) {  // of this frame: the next one may be smaller
      throw InputError(file.string(), "there is not enough memory for it");
    }
  }

  void skip() override {
    if (at_ < frames_.size() || loop_) {
      ++at_;
    }
  }

  std::vector<std::string> notes() const override { return notes_; }

 private:
  // Seconds from the first frame to the first of the next round.
  double length() const { return frames_.back().time - frames_.front().time + 1.0 / kFramesPerSecond; }

  Frame read(const fs::path& file) const {
    if (!is_one_file_) {
      expect_regular(file);
    }
    const std::string bytes = read_file(file);
    if (lower_extension(file) == ".pcd") {
      return frame_of_cloud(read_organized_pcd(bytes, limits_));
    }
    if (kind_of_picture(bytes) == PictureKind::few_bits) {
      throw InputError("has pixels of 8 bits or fewer where 16 bits were expected: grey tones, and no depths");
    }
    Frame frame;
    frame.image = decode_depth_png(bytes, *calibration_.units_per_metre, limits_);
    frame.intrinsics = calibration_.intrinsics;
    const int width = calibration_.width.value_or(frame.image.width);
    const int height = calibration_.height.value_or(frame.image.height);
    if (frame.image.width != width || frame.image.height != height) {
      throw InputError(fmt::format("is {} x {} pixels large where the calibration says {} x {}", frame.image.width,
                                   frame.image.height, width, height));
    }
    return frame;
  }

  fs::path folder_;
  FrameList frames_;
  std::vector<std::string> notes_;
  bool is_one_file_;
  CameraCalibration calibration_;  // with its units
  ReadLimits limits_;
  bool loop_;
  std::size_t at_ = 0;
};

}  // namespace

void FrameSource::skip() {
  try {
    static_cast<void>(next());
  } catch (const InputError&) {  // it is left out all the same
  }
}

std::vector<std::string> FrameSource::notes() const {
  return {};
}

std::unique_ptr<FrameSource> open_recording(const fs::path& place, const FrameSettings& settings) {
  RecordingFiles files = find_recording(place);
  CameraCalibration calibration;
  calibration.width = 640;  // a Kinect's: of other cameras there is nothing to be guessed
  calibration.height = 480;
  if (settings.calibration) {
    calibration = read_calibration(*settings.calibration);
  } else if (files.calibration) {
    expect_regular(*files.calibration);
    calibration = read_calibration(*files.calibration);
    if (files.calibration->filename() != kOwnCalibration) {
      files.notes.push_back("its camera is that of " + files.calibration->string());
    }
  }
  if (settings.units_per_metre) {
    calibration.units_per_metre = settings.units_per_metre;
  } else if (!calibration.units_per_metre) {
    calibration.units_per_metre = files.is_of_tum ? kUnitsOfTum : kUsualUnits;
    if (files.is_of_tum) {
      files.notes.push_back(
          fmt::format("a recording of TUM's: {} units a metre (--units N says otherwise)", kUnitsOfTum));
    }
  }
  for (std::string& note : files.notes) {
    note = place.string() + ": " + note;
  }
  return std::make_unique<Recording>(std::move(files), calibration, settings);
}

}  // namespace spincat
