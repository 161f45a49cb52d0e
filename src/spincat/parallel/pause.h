// How long a rank sleeps between two looks for messages.
#pragma once

#include <algorithm>
#include <chrono>

namespace spincat {

// Not at all while something happens, a moment while large messages are on their way (MPI moves them on only while it
// is called, some megabytes at a time), then longer and longer, up to two milliseconds: a rank that only waits uses a
// percent or two of a core. Beside threads that work, half a millisecond is the least, and two where no message is on
// its way: each look takes a core from them (2 % of it, with shorter pauses), and whoever works has tasks enough
// (task_farm.cpp), so nobody waits for us. A finished task of our own ends the pause.
class Pause {
 public:
  using Clock = std::chrono::steady_clock;

  // What a rank saw when it looked.
  struct Look {
    bool happened = false;      // a message came, a task was finished
    bool under_way = false;     // messages are on their way
    bool threads_work = false;  // this rank's own, at a task
  };

  // The next pause.
  std::chrono::microseconds after(const Look& look) {
    const auto now = Clock::now();
    if (look.happened) {
      last_ = now;
      pause_ = kShortest;
      return std::chrono::microseconds(0);
    }
    if (look.under_way && now - last_ < kTransferPatience) {  // a message to a lost rank never ends
      return look.threads_work ? kTransferBesideWork : kTransfer;
    }
    const auto pause = look.threads_work ? kLongest : pause_;
    pause_ = std::min(2 * pause, kLongest);
    return pause;
  }

 private:
  static constexpr std::chrono::microseconds kShortest{20};
  static constexpr std::chrono::microseconds kTransfer{50};
  static constexpr std::chrono::microseconds kTransferBesideWork{500};
  static constexpr std::chrono::microseconds kLongest{2000};
  static constexpr std::chrono::milliseconds kTransferPatience{20};
  std::chrono::microseconds pause_ = kShortest;
  Clock::time_point last_;
};

}  // namespace spincat
