// Recordings: files of depth frames.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_list.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/files/system_error_text.h"
#include "spincat/io/organized_cloud.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

constexpr double kFramesPerSecond = 30.0;  // where a recording tells no times

// Names in the order in which people count: frame9 before frame10.
bool natural_less(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto number = [&](const std::string& text, std::size_t& at) {
        const std::size_t first = std::min(text.find_first_not_of('0', at), text.size());
        at = first;
        while (at < text.size() && is_digit(text[at])) {
          ++at;
        }
        return text.substr(first, at - first);
      };
      const std::string x = number(a, i);
      const std::string y = number(b, j);
      if (x != y) {
        return x.size() != y.size() ? x.size() < y.size() : x < y;
      }
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

// A list without its last line where that was cut off, by a power cut or a full disk, while it was written: it has no
// end, and it is no line of a list or names no file that is there. What is left of one frame is no reason to refuse all
// others; and the last line of many a list that is whole has no end.
std::string_view without_cut_line(std::string_view text, const fs::path& folder) {
  const std::size_t last = text.find_last_of("\r\n") + 1;  // 0: there is but one line
  if (last == 0 || last == text.size()) {
    return text;
  }
  try {
    const FrameList frames = parse_depth_list(text.substr(last));
    if (frames.empty() || fs::exists(status_of(folder / frames.front().file))) {
      return text;
    }
  } catch (const InputError&) {
  }
  return text.substr(0, last);
}

FrameList listed_files(const fs::path& list) {
  expect_regular(list);
  return naming_file(list, [&] {
    const std::string text = read_file(list);
    return parse_depth_list(without_cut_line(text, list.parent_path()));
  });
}

FrameList files_in(const fs::path& folder) {
  if (fs::exists(status_of(folder / "depth.txt"))) {
    return listed_files(folder / "depth.txt");
  }
  std::vector<std::string> pictures;
  std::vector<std::string> clouds;
  std::error_code error;
  fs::directory_iterator next(folder, error);
  for (; !error && next != fs::directory_iterator(); next.increment(error)) {
    const std::string extension = lower_extension(next->path());
    if (extension == ".png") {
      pictures.push_back(next->path().filename().string());
    } else if (extension == ".pcd") {
      clouds.push_back(next->path().filename().string());
    }
  }
  if (error) {
    throw InputError(folder.string(), "cannot be read: " + system_error_text(error.value()));
  }
  std::vector<std::string>& files = pictures.empty() ? clouds : pictures;
  std::ranges::sort(files, natural_less);
  FrameList frames;
  for (std::string& file : files) {
    frames.push_back({std::move(file), static_cast<double>(frames.size()) / kFramesPerSecond});
  }
  return frames;
}

// The line of least squares through places (at, value): value = slope at + offset. `for_each_place` calls what it is
// given with each place; twice, so that no place need be kept.
struct Line {
  double slope;
  double offset;
};

template <class ForEachPlace>
Line fitted_line(std::size_t places, const ForEachPlace& for_each_place) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(places);
  for_each_place([&](double at, double value) {
    x += at / n;
    y += value / n;
  });
  for_each_place([&](double at, double value) {
    xx += (at - x) * (at - x);
    xy += (at - x) * (value - y);
  });
  const double slope = xy / xx;
  return {slope, y - slope * x};
}

// Calls `see` with each point that was measured, its column and its row.
template <class See>
void for_each_measured(const OrganizedCloud& cloud, const See& see) {
  std::size_t i = 0;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Vec3& p = cloud.points[i++];
      if (p.allFinite() && p.z() > 0.0) {
        see(p, u, v);
      }
    }
  }
}

// An organized cloud as the picture that it was made of: u = fx x / z + cx.
Frame frame_of(const OrganizedCloud& cloud) {
  Frame frame;
  frame.image = DepthImage(cloud.width, cloud.height);
  std::size_t measured = 0;
  for_each_measured(cloud, [&](const Vec3& p, int u, int v) {
    frame.image.depth[frame.image.index(u, v)] = static_cast<float>(p.z());
    ++measured;
  });
  constexpr std::size_t kFewest = 10;
  if (measured >= kFewest) {
    const Line x = fitted_line(measured, [&](const auto& see) {
      for_each_measured(cloud, [&](const Vec3& p, int u, int) { see(p.x() / p.z(), u); });
    });
    const Line y = fitted_line(measured, [&](const auto& see) {
      for_each_measured(cloud, [&](const Vec3& p, int, int v) { see(p.y() / p.z(), v); });
    });
    frame.intrinsics = {x.slope, y.slope, x.offset, y.offset};
    frame.intrinsics.validate();
  }
  return frame;
}

class Recording : public FrameSource {
 public:
  // `is_one_file`: that the user named.
  Recording(fs::path folder, FrameList frames, bool is_one_file, const CameraCalibration& calibration,
            const FrameSettings& settings)
      : folder_(std::move(folder)),
        frames_(std::move(frames)),
        is_one_file_(is_one_file),
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

 private:
  // Seconds from the first frame to the first of the next round.
  double length() const { return frames_.back().time - frames_.front().time + 1.0 / kFramesPerSecond; }

  Frame read(const fs::path& file) const {
    if (!is_one_file_) {
      expect_regular(file);
    }
    const std::string bytes = read_file(file);
    if (lower_extension(file) == ".pcd") {
      return frame_of(read_organized_pcd(bytes, limits_));
    }
    Frame frame;
    frame.image = decode_depth_png(bytes, calibration_.units_per_metre, limits_);
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
  bool is_one_file_;
  CameraCalibration calibration_;
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

std::unique_ptr<FrameSource> open_recording(const fs::path& place, const FrameSettings& settings) {
  const fs::file_status status = status_of(place);
  if (!fs::exists(status)) {
    throw InputError(place.string(), "no such file or folder");
  }
  const bool is_folder = fs::is_directory(status);
  const fs::path folder = is_folder ? place : place.parent_path();
  FrameList frames = is_folder ? files_in(place) : FrameList{{place.filename().string(), 0.0}};
  if (frames.empty()) {
    throw InputError(place.string(), "holds no depth pictures (.png) and no organized clouds (.pcd)");
  }
  CameraCalibration calibration;
  calibration.width = 640;  // a Kinect's: of other cameras there is nothing to be guessed
  calibration.height = 480;
  const fs::path beside = folder / "camera.txt";
  if (settings.calibration) {
    calibration = read_calibration(*settings.calibration);
  } else if (fs::exists(status_of(beside))) {
    expect_regular(beside);
    calibration = read_calibration(beside);
  }
  calibration.units_per_metre = settings.units_per_metre.value_or(calibration.units_per_metre);
  return std::make_unique<Recording>(folder, std::move(frames), !is_folder, calibration, settings);
}

}  // namespace spincat
