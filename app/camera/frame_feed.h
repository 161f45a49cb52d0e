// Frames on their way from a source to who looks at them: all of them, or the newest.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/camera/latest.h"
#include "spincat/camera/source/frame_source.h"

namespace spincat::app {

// A frame, or why it could not be read.
struct FedFrame {
  std::size_t number = 0;  // of the source's frames, from 0
  Frame frame;
  std::string error;          // empty where there is a frame
  double read_seconds = 0.0;  // reading and decoding
  std::size_t dropped = 0;    // frames so far that were replaced by newer ones before they were taken
};

class FrameFeed {
 public:
  virtual ~FrameFeed() = default;

  // The next frame, after a short wait at most: nothing where there is none yet. Throws what the source throws, but for
  // a frame that cannot be read (InputError), which is a FedFrame, too.
  virtual std::optional<FedFrame> next() = 0;
  // No more frames will come.
  virtual bool ended() const = 0;
  // It ended after ten frames in a row that could not be read, and there were more.
  virtual bool gave_up() const = 0;
};

// Every `every`-th frame of the source, each when it is asked for. Ends after ten frames in a row that cannot be read:
// a recording that has disappeared.
std::unique_ptr<FrameFeed> feed_all(std::unique_ptr<FrameSource> source, std::size_t every);

// Frames in their own time, read on a thread of its own: the newest is handed on, and those that it replaces are
// dropped and counted. Holds two frames at most. A gap of the source's times counts as no more than five seconds a
// frame, one that goes back as none.
std::unique_ptr<FrameFeed> feed_in_real_time(std::unique_ptr<FrameSource> source, std::size_t every);

}  // namespace spincat::app
