#include "app/camera/camera_painter.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "app/terminal/terminal.h"
#include "spincat/geometry/start_thread.h"

namespace spincat::app {
namespace {

constexpr std::chrono::milliseconds kBetweenDraws(100);
constexpr std::size_t kMostLines = 24;  // more would scroll away

}  // namespace

CameraPainter::CameraPainter(const CameraState& state, const std::vector<std::string>& categories)
    : state_(state), categories_(categories), thread_(start_thread([this] { draw_on(); })) {}

void CameraPainter::finish() {
  if (thread_.joinable()) {
    thread_.join();
  }
}

void CameraPainter::draw_on() {
  lower_priority();
  std::uint64_t number = 0;
  while (true) {
    const CameraState::Shown shown = state_.newer_than(number, kBetweenDraws);
    if (shown.frame) {
      const std::size_t columns = terminal_width(STDOUT_FILENO, 80) - 1;
      draw(frame_lines(shown.frame->facts, shown.frame->seen, categories_, columns));
      number = shown.number;
    }
    if (shown.ended) {
      return;
    }
    if (shown.frame) {
      std::this_thread::sleep_for(kBetweenDraws);
    }
  }
}

void CameraPainter::draw(const std::vector<std::string>& lines) {
  const std::size_t count = std::min(lines.size(), kMostLines);
  std::string text = drawn_ > 0 ? fmt::format("\x1b[{}A", drawn_) : "";
  for (std::size_t i = 0; i < count; ++i) {
    text += "\r" + lines[i] + "\x1b[K\n";
  }
  text += "\x1b[J";  // what is left of a longer drawing
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
  drawn_ = count;
}

}  // namespace spincat::app
