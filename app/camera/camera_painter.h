// Lines on a terminal that are updated in place, drawn by a thread of its own: a terminal that stalls stalls no frame.
#pragma once

#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "app/camera/camera_state.h"

namespace spincat::app {

class CameraPainter {
 public:
  // Draws on standard output, ten times a second at most, until the state has ended. Both must outlive it.
  CameraPainter(const CameraState& state, const std::vector<std::string>& categories);

  // Waits until the last frame is drawn. The state must have ended.
  void finish();

 private:
  void draw_on();
  void draw(const std::vector<std::string>& lines);

  const CameraState& state_;
  const std::vector<std::string>& categories_;
  std::size_t drawn_ = 0;  // lines that the next drawing replaces
  std::jthread thread_;
};

}  // namespace spincat::app
