// What the loop last saw, for those who show it: they take what is newest and never hold up the loop.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "spincat/camera/source/frame_source.h"
#include "spincat/classify/recogniser.h"
#include "spincat/report/camera_report.h"

namespace spincat::app {

struct ShownFrame {
  FrameFacts facts;
  DepthImage image;
  SeenFrame seen;
  double frames_a_second = 0.0;  // of the last second or so, reading included
};

class CameraState {
 public:
  void show(std::shared_ptr<const ShownFrame> frame);
  // Nothing more will come.
  void end();

  struct Shown {
    std::uint64_t number = 0;                 // counts what was shown, from 1
    std::shared_ptr<const ShownFrame> frame;  // null: nothing newer came in time
    bool ended = false;
  };
  // The newest frame, if it is newer than number `after`; waits for it no longer than that.
  Shown newer_than(std::uint64_t after, std::chrono::milliseconds longest) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::uint64_t number_ = 0;
  std::shared_ptr<const ShownFrame> frame_;
  bool ended_ = false;
};

// Gives the calling thread what others leave of the processor.
void lower_priority();

}  // namespace spincat::app
