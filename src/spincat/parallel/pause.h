// Private to parallel: how long a rank sleeps between two looks for messages.
#pragma once

#include <algorithm>
#include <chrono>

namespace spincat {

// Not at all while something happens or large messages are on their way, then longer and longer, up to a millisecond:
// a rank that only waits uses two or three percent of a core.
class Pause {
 public:
  using Clock = std::chrono::steady_clock;

  // The next pause, after a look in which something `happened`, with messages `under_way` or not.
  std::chrono::microseconds next(bool happened, bool under_way) {
    const auto now = Clock::now();
    if (happened) {
      last_ = now;
      pause_ = kShortest;
    }
    // MPI moves large messages on only while it is called. But one to a lost rank never ends.
    if (happened || (under_way && now - last_ < kTransferPatience)) {
      return std::chrono::microseconds(0);
    }
    const auto pause = pause_;
    pause_ = std::min(2 * pause_, kLongest);
    return pause;
  }

 private:
  static constexpr std::chrono::microseconds kShortest{20};
  static constexpr std::chrono::microseconds kLongest{1000};
  static constexpr std::chrono::milliseconds kTransferPatience{20};
  std::chrono::microseconds pause_ = kShortest;
  Clock::time_point last_;
};

}  // namespace spincat
