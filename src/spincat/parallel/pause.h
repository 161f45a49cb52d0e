// Private to parallel: how long a rank sleeps between two looks for messages.
#pragma once

#include <algorithm>
#include <chrono>

namespace spincat {

// Not at all while something happens, a moment while large messages are on their way (MPI moves them on only while it
// is called, some megabytes at a time), then longer and longer, up to two milliseconds: a rank that only waits uses a
// percent or two of a core, and whoever works has two tasks (task_farm.cpp), so that it does not wait for us.
class Pause {
 public:
  using Clock = std::chrono::steady_clock;

  // The next pause, after a look in which something `happened`, with messages `under_way` or not.
  std::chrono::microseconds next(bool happened, bool under_way) {
    const auto now = Clock::now();
    if (happened) {
      last_ = now;
      pause_ = kShortest;
      return std::chrono::microseconds(0);
    }
    if (under_way && now - last_ < kTransferPatience) {  // a message to a lost rank never ends
      return kTransfer;
    }
    const auto pause = pause_;
    pause_ = std::min(2 * pause_, kLongest);
    return pause;
  }

 private:
  static constexpr std::chrono::microseconds kShortest{20};
  static constexpr std::chrono::microseconds kTransfer{50};
  static constexpr std::chrono::microseconds kLongest{2000};
  static constexpr std::chrono::milliseconds kTransferPatience{20};
  std::chrono::microseconds pause_ = kShortest;
  Clock::time_point last_;
};

}  // namespace spincat
