// What a depth camera hands over, pictures of distances, and where they come from.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spincat/io/read_limits.h"

#pragma GCC visibility push(default)
namespace spincat {

// A pinhole camera: pixel (u, v) with depth z is the point ((u - cx) z / fx, (v - cy) z / fy, z): x to the right, y
// down, z forward. In pixels; the defaults are those of a Kinect's 640 x 480.
struct Intrinsics {
  double fx = 525.0;
  double fy = 525.0;
  double cx = 319.5;
  double cy = 239.5;

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;

  Eigen::Vector3f point(int u, int v, float z) const {
    return {static_cast<float>((u - cx) / fx) * z, static_cast<float>((v - cy) / fy) * z, z};
  }
};

// width x height depths along the optical axis in metres, row by row from the top; 0 where nothing was read. Finite
// (readers see to that; the recogniser takes others for not read).
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> depth;

  DepthImage() = default;
  DepthImage(int columns, int rows)
      : width(columns), height(rows), depth(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0F) {}

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  float at(int u, int v) const { return depth[index(u, v)]; }
};

struct Frame {
  std::string name;   // of its file
  double time = 0.0;  // seconds, as the recording tells it; else its number over 30
  DepthImage image;
  Intrinsics intrinsics;
};

// Frames one after the other.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // The next frame, or nothing after the last. Throws InputError, naming the file, when a frame cannot be read; the one
  // after it may be asked for then.
  virtual std::optional<Frame> next() = 0;

  // Leaves the next frame out, where there is one. Does not throw for a frame that cannot be read.
  virtual void skip();

  // What its user should know of how it was opened, a line each.
  virtual std::vector<std::string> notes() const;
};

struct FrameSettings {
  std::optional<std::filesystem::path> calibration;  // a file as read_calibration reads it; else one that lies with the
                                                     // frames, else that of a Kinect (640 x 480)
  std::optional<double> units_per_metre;             // of the numbers in depth pictures; else the calibration's; else
                                                     // 5000 of a recording of TUM's, 1000 of others
  bool loop = false;                                 // after the last frame comes the first
  ReadLimits limits;                                 // of each frame's file
};

// A recording: a folder of grey PNG files of 16 bits in the order of their names (of TUM's depth.txt where there is
// one, which gives times as well), a folder of organized PCD files, or one file of either kind. An organized PCD
// carries its own calibration. Beside depth pictures those in colours or of fewer bits are passed over; a folder
// without depth pictures may have them in a sub-folder "depth". A calibration that lies with the frames is camera.txt,
// or one of the names that other programs give theirs (docs/guide/camera.md). Throws InputError naming the file or
// folder when there is no frame, or the list or the calibration cannot be read. What a folder holds or a list names
// must be a regular file (or a link to one): else that frame, list or calibration cannot be read. The list's last line
// is left out where it has no end and is no line, or names a file that is not there: it was cut off. One file that is
// named by itself may be a pipe.
std::unique_ptr<FrameSource> open_recording(const std::filesystem::path& place, const FrameSettings& settings);

}  // namespace spincat
#pragma GCC visibility pop
