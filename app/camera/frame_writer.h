// Files of frames, written on a thread of their own: --record and --masks.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "spincat/camera/source/frame_source.h"
#include "spincat/classify/recogniser.h"
#include "spincat/files/locked_file.h"

namespace spincat::app {

// Does jobs in their order, and holds a few at most.
class WriterThread {
 public:
  // `waits`: where there are too many, add() waits; otherwise it leaves the job out.
  explicit WriterThread(bool waits);
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  // Whether the job will be done. Throws what an earlier job threw.
  bool add(std::function<void()> job);
  // Waits until all jobs are done. Throws what one of them threw.
  void finish();

 private:
  void work_on();

  bool waits_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool busy_ = false;
  bool stop_ = false;
  std::exception_ptr error_;
  std::jthread thread_;
};

// A recording that open_recording reads: depth pictures, TUM's depth.txt and camera.txt.
class FrameRecorder {
 public:
  // Makes the folder; throws InputError when it holds anything: a recording is not mixed with another.
  FrameRecorder(const std::filesystem::path& folder, WriterThread& writer);

  void add(const Frame& frame);
  // Waits until the list is on the disk; each frame has waited for its own picture. The writer must have finished.
  void finish();
  std::size_t left_out() const { return left_out_; }

 private:
  void write(const Frame& frame, std::size_t number);

  std::filesystem::path folder_;
  WriterThread& writer_;
  std::optional<LockedFile> list_;  // from the first frame on; the writer's, as `listed_`
  std::uint64_t listed_ = 0;        // bytes of whole lines
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
};

// For each frame a 16-bit picture of the objects' ids, 0 elsewhere, under the frame's name.
class MaskWriter {
 public:
  // As FrameRecorder.
  MaskWriter(const std::filesystem::path& folder, WriterThread& writer);

  // `number`: of the frame, which names the file.
  void add(std::size_t number, const SeenFrame& frame, int width, int height);
  std::size_t left_out() const { return left_out_; }

 private:
  std::filesystem::path folder_;
  WriterThread& writer_;
  std::size_t left_out_ = 0;
};

// For each frame the points of each object and of the table as PLY files, in metres in the camera's frame:
// FRAME-ID.ply, FRAME-table.ply.
class CloudWriter {
 public:
  // As FrameRecorder.
  CloudWriter(const std::filesystem::path& folder, WriterThread& writer);

  // `number`: of the frame, which names the files.
  void add(std::size_t number, const SeenFrame& frame, const DepthImage& image, const Intrinsics& intrinsics);
  std::size_t left_out() const { return left_out_; }

 private:
  std::filesystem::path folder_;
  WriterThread& writer_;
  std::size_t left_out_ = 0;
};

}  // namespace spincat::app
