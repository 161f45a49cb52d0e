// Files of frames for whom the disk is too slow.
#include "app/camera/frame_writer.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "support/temp_dir.h"

namespace spincat::app {
namespace {

// A job that lasts until it is told to end.
class Barrier {
 public:
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return open_; });
  }
  void open() {
    {
      const std::lock_guard lock(mutex_);
      open_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
};

TEST(FrameWriter, WhatComesTooFastIsLeftOutAndCounted) {
  const test::TempDir dir;
  WriterThread writer(false);
  FrameRecorder recorder(dir / "record", writer);
  MaskWriter masks(dir / "masks", writer);
  Barrier barrier;
  constexpr std::size_t kFrames = 20;
  writer.add([&] { barrier.wait(); });
  Frame frame;
  frame.image = DepthImage(4, 3);
  for (std::size_t k = 0; k < kFrames; ++k) {
    recorder.add(frame);
    masks.add(k, SeenFrame{}, 4, 3);
  }
  barrier.open();
  writer.finish();
  recorder.finish();
  const auto written = [](const std::filesystem::path& folder) {
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      pictures += entry.path().extension() == ".png" ? 1 : 0;
    }
    return pictures;
  };
  EXPECT_GT(recorder.left_out(), 0U);
  EXPECT_GT(masks.left_out(), 0U);
  EXPECT_EQ(written(dir / "record") + recorder.left_out(), kFrames);
  EXPECT_EQ(written(dir / "masks") + masks.left_out(), kFrames);
}

}  // namespace
}  // namespace spincat::app
