#include "app/camera/frame_writer.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "spincat/camera/segment/table.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/system_error_text.h"
#include "spincat/geometry/start_thread.h"
#include "spincat/io/write_object.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostJobs = 8;
constexpr double kUnitsPerMetre = 5'000.0;  // of recordings: 0.2 mm, up to 13 m

void make_empty_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    throw InputError(folder.string(),
                     "cannot be made a folder" + (error ? ": " + system_error_text(error.value()) : ""));
  }
  const bool is_empty = fs::is_empty(folder, error);
  if (error) {
    throw InputError(folder.string(), "cannot be read: " + system_error_text(error.value()));
  }
  if (!is_empty) {
    throw InputError(folder.string(), "is not empty");
  }
}

bool is_over(const std::vector<Eigen::Vector3f>& outline, const SupportPlane& table, const Eigen::Vector3f& point) {
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector3f edge = outline[(k + 1) % outline.size()] - outline[k];
    if (edge.cross(Eigen::Vector3f(point - outline[k])).dot(table.normal) < 0.0F) {
      return false;
    }
  }
  return !outline.empty();
}

// The readings of each object, by its number in the segmentation, and under 0 those of the table.
std::vector<PointCloud> clouds_of(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                                  const Segmentation& segmentation) {
  std::vector<PointCloud> clouds(segmentation.objects.size() + 1);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const float z = image.at(u, v);
      const Eigen::Vector3f p = intrinsics.point(u, v, z);
      const std::uint16_t id = segmentation.ids[image.index(u, v)];
      const bool is_on_table =
          std::abs(table.height(p)) < plane_tolerance(z) && is_over(segmentation.outline, table, p);
      if (z > 0.0F && (id != 0 || is_on_table)) {
        clouds[id].points.push_back(p.cast<double>());
      }
    }
  }
  return clouds;
}

}  // namespace

WriterThread::WriterThread(bool waits) : waits_(waits), thread_(start_thread([this] { work_on(); })) {}

WriterThread::~WriterThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool WriterThread::add(std::function<void()> job) {
  std::unique_lock lock(mutex_);
  if (waits_) {
    changed_.wait(lock, [&] { return jobs_.size() < kMostJobs || error_; });
  }
  if (error_) {
    std::rethrow_exception(error_);
  }
  if (jobs_.size() >= kMostJobs) {
    return false;
  }
  jobs_.push_back(std::move(job));
  changed_.notify_all();
  return true;
}

void WriterThread::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return (jobs_.empty() && !busy_) || error_; });
  if (error_) {
    std::rethrow_exception(error_);
  }
}

void WriterThread::work_on() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stop_ || !jobs_.empty(); });
    if (jobs_.empty() || error_) {
      return;
    }
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      job();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    error_ = error;
    changed_.notify_all();
  }
}

FrameRecorder::FrameRecorder(const fs::path& folder, WriterThread& writer) : folder_(folder), writer_(writer) {
  make_empty_folder(folder);
}

void FrameRecorder::add(const Frame& frame) {
  const std::size_t number = count_;
  if (writer_.add([this, frame, number] { write(frame, number); })) {
    ++count_;
  } else {
    ++left_out_;
  }
}

void FrameRecorder::write(const Frame& frame, std::size_t number) {
  if (number == 0) {
    const CameraCalibration calibration{frame.intrinsics, kUnitsPerMetre, frame.image.width, frame.image.height};
    write_file_atomically(folder_ / "camera.txt", calibration_text(calibration));
  }
  const std::string name = fmt::format("{:06}.png", number);
  write_file_atomically(folder_ / name, encode_depth_png(frame.image, kUnitsPerMetre));
  // The list grows last: what it names is there.
  if (!list_) {
    list_.emplace(folder_ / "depth.txt");
  }
  const std::string line = fmt::format("{:.6f} {}\n", frame.time, name);
  try {
    list_->write(listed_, line);
  } catch (const RunError&) {
    list_->cut(listed_);  // a full disk takes a part of a line
    throw;
  }
  listed_ += line.size();
}

void FrameRecorder::finish() {
  if (list_) {
    list_->flush();
  }
}

MaskWriter::MaskWriter(const fs::path& folder, WriterThread& writer) : folder_(folder), writer_(writer) {
  make_empty_folder(folder);
}

void MaskWriter::add(std::size_t number, const SeenFrame& frame, int width, int height) {
  constexpr std::uint64_t kMostId = 65'535;  // that a picture can hold: then they begin again at 1
  std::vector<std::uint16_t> id_of(frame.objects.size() + 1, 0);
  for (const SeenObject& object : frame.objects) {
    id_of[object.segment.id] = static_cast<std::uint16_t>((object.id - 1) % kMostId + 1);
  }
  std::vector<std::uint16_t> ids(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  std::ranges::transform(frame.segmentation.ids, ids.begin(), [&](std::uint16_t id) { return id_of[id]; });
  const fs::path file = folder_ / fmt::format("{:06}.png", number);
  const bool is_taken = writer_.add(
      [file, ids = std::move(ids), width, height] { write_file_atomically(file, encode_png16(ids, width, height)); });
  left_out_ += is_taken ? 0 : 1;
}

CloudWriter::CloudWriter(const fs::path& folder, WriterThread& writer) : folder_(folder), writer_(writer) {
  make_empty_folder(folder);
}

void CloudWriter::add(std::size_t number, const SeenFrame& frame, const DepthImage& image,
                      const Intrinsics& intrinsics) {
  if (!frame.table || frame.segmentation.ids.empty()) {
    return;
  }
  std::vector<std::string> names = {"table"};
  for (const SeenObject& object : frame.objects) {
    names.push_back(std::to_string(object.id));
  }
  const bool is_taken = writer_.add([folder = folder_, number, image, intrinsics, table = *frame.table,
                                     segmentation = frame.segmentation, names = std::move(names)] {
    const std::vector<PointCloud> clouds = clouds_of(image, intrinsics, table, segmentation);
    for (std::size_t k = 0; k < clouds.size(); ++k) {
      if (!clouds[k].points.empty()) {
        write_object(folder / fmt::format("{:06}-{}.ply", number, names[k]), clouds[k]);
      }
    }
  });
  left_out_ += is_taken ? 0 : 1;
}

}  // namespace spincat::app
