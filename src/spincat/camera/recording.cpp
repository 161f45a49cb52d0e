// Recordings: files of depth frames.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

#include "spincat/camera/calibration.h"
#include "spincat/camera/depth_png.h"
#include "spincat/camera/frame_source.h"
#include "spincat/error.h"
#include "spincat/io/file.h"
#include "spincat/io/organized_cloud.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

constexpr double kFramesPerSecond = 30.0;  // where a recording tells no times

struct Entry {
  fs::path file;
  double time;
};

bool has_extension(const fs::path& file, std::string_view extension) {
  std::string own = file.extension().string();
  std::ranges::transform(own, own.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return own == extension;
}

// Names in the order in which people count: frame9 before frame10.
bool counts_before(const std::string& a, const std::string& b) {
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

// TUM's list: lines "time file", # before what says nothing.
std::vector<Entry> listed_files(const fs::path& list) {
  std::vector<Entry> entries;
  std::istringstream text(read_file(list));
  text.imbue(std::locale::classic());
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') {
      continue;
    }
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    double time = 0.0;
    std::string file;
    if (!(words >> time >> file)) {
      throw InputError(list.string(), fmt::format("line {}: expected a time and a file", number));
    }
    entries.push_back({list.parent_path() / file, time});
  }
  return entries;
}

std::vector<Entry> files_in(const fs::path& folder) {
  if (fs::exists(folder / "depth.txt")) {
    return listed_files(folder / "depth.txt");
  }
  std::vector<fs::path> pictures;
  std::vector<fs::path> clouds;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (has_extension(entry.path(), ".png")) {
      pictures.push_back(entry.path());
    } else if (has_extension(entry.path(), ".pcd")) {
      clouds.push_back(entry.path());
    }
  }
  std::vector<fs::path>& files = pictures.empty() ? clouds : pictures;
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    return counts_before(a.filename().string(), b.filename().string());
  });
  std::vector<Entry> entries;
  for (fs::path& file : files) {
    entries.push_back({std::move(file), static_cast<double>(entries.size()) / kFramesPerSecond});
  }
  return entries;
}

// The line of least squares through places (at, value): value = slope at + offset.
struct Line {
  double slope;
  double offset;
};

Line fitted_line(const std::vector<std::pair<double, double>>& places) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(places.size());
  for (const auto& [at, value] : places) {
    x += at / n;
    y += value / n;
  }
  for (const auto& [at, value] : places) {
    xx += (at - x) * (at - x);
    xy += (at - x) * (value - y);
  }
  const double slope = xy / xx;
  return {slope, y - slope * x};
}

// An organized cloud as the picture that it was made of: u = fx x / z + cx.
Frame frame_of(const OrganizedCloud& cloud) {
  Frame frame;
  frame.image = DepthImage(cloud.width, cloud.height);
  std::vector<std::pair<double, double>> across;
  std::vector<std::pair<double, double>> down;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Vec3& p = cloud.points[frame.image.index(u, v)];
      if (p.allFinite() && p.z() > 0.0) {
        frame.image.depth[frame.image.index(u, v)] = static_cast<float>(p.z());
        across.emplace_back(p.x() / p.z(), u);
        down.emplace_back(p.y() / p.z(), v);
      }
    }
  }
  constexpr std::size_t kFewest = 10;
  if (across.size() >= kFewest) {
    const Line x = fitted_line(across);
    const Line y = fitted_line(down);
    frame.intrinsics = {x.slope, y.slope, x.offset, y.offset};
    frame.intrinsics.validate();
  }
  return frame;
}

class Recording : public FrameSource {
 public:
  Recording(std::vector<Entry> files, const CameraCalibration& calibration, bool loop)
      : files_(std::move(files)), calibration_(calibration), loop_(loop) {}

  std::optional<Frame> next() override {
    if (at_ == files_.size() && !loop_) {
      return {};
    }
    const Entry& entry = files_[at_ % files_.size()];
    const std::size_t round = at_++ / files_.size();
    try {
      Frame frame = read(entry.file);
      frame.name = entry.file.filename().string();
      frame.time = entry.time + static_cast<double>(round) * length();
      return frame;
    } catch (const InputError& error) {
      throw error.file().empty() ? InputError(entry.file.string(), error.problem()) : error;
    }
  }

  void skip() override {
    if (at_ < files_.size() || loop_) {
      ++at_;
    }
  }

 private:
  // Seconds from the first frame to the first of the next round.
  double length() const { return files_.back().time - files_.front().time + 1.0 / kFramesPerSecond; }

  Frame read(const fs::path& file) const {
    const std::string bytes = read_file(file);
    if (has_extension(file, ".pcd")) {
      return frame_of(read_organized_pcd(bytes));
    }
    Frame frame;
    frame.image = decode_depth_png(bytes, calibration_.units_per_metre);
    frame.intrinsics = calibration_.intrinsics;
    const int width = calibration_.width.value_or(frame.image.width);
    const int height = calibration_.height.value_or(frame.image.height);
    if (frame.image.width != width || frame.image.height != height) {
      throw InputError(fmt::format("is {} x {} pixels large where the calibration says {} x {}", frame.image.width,
                                   frame.image.height, width, height));
    }
    return frame;
  }

  std::vector<Entry> files_;
  CameraCalibration calibration_;
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
  if (!fs::exists(place)) {
    throw InputError(place.string(), "no such file or folder");
  }
  const bool is_folder = fs::is_directory(place);
  std::vector<Entry> files = is_folder ? files_in(place) : std::vector<Entry>{{place, 0.0}};
  if (files.empty()) {
    throw InputError(place.string(), "holds no depth pictures (.png) and no organized clouds (.pcd)");
  }
  CameraCalibration calibration;
  calibration.width = 640;  // a Kinect's: of other cameras there is nothing to be guessed
  calibration.height = 480;
  const fs::path beside = (is_folder ? place : place.parent_path()) / "camera.txt";
  if (settings.calibration) {
    calibration = read_calibration(*settings.calibration);
  } else if (fs::exists(beside)) {
    calibration = read_calibration(beside);
  }
  calibration.units_per_metre = settings.units_per_metre.value_or(calibration.units_per_metre);
  return std::make_unique<Recording>(std::move(files), calibration, settings.loop);
}

}  // namespace spincat
