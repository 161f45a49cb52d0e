// How far the work is, for a person at a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "app/options.h"
#include "spincat/execution.h"

namespace spincat::app {

// One line on standard error with a bar, the rate and the time left: only when that is a terminal, the work is longer
// than a second, and --quiet is not given. The line is wiped when the bar goes. Also the place where Ctrl-C takes
// effect.
class ProgressBar {
 public:
  explicit ProgressBar(const RunOptions& run);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // For the library's functions; the bar must outlive it.
  Progress callback();
  void update(std::string_view stage, std::size_t done, std::size_t total);
  void wipe();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_ = false;
  bool drawn_ = false;
  std::string stage_;
  Clock::time_point stage_start_ = Clock::now();
  Clock::time_point last_draw_;
};

}  // namespace spincat::app
