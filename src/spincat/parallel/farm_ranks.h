// What rank 0 knows of another rank, and how long tasks take.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "spincat/parallel/farm_messages.h"
#include "spincat/parallel/task_farm.h"

namespace spincat {

// When we were away so long ourselves, the silence of others means nothing.
inline constexpr std::chrono::milliseconds kStall(500);

// The same bytes can be on their way to many ranks.
inline SharedBytes to_send(std::string bytes) {
  return std::make_shared<const std::string>(std::move(bytes));
}

struct TaskFarm::Rank {
  farm::Greeting greeting;
  int threads = 0;               // once it has said so
  bool ready = false;            // for the job that is on
  bool refused = false;          // cannot do the job that is on
  std::string refusal;           // why, the last time
  bool lost = false;             // has been silent for too long
  bool left = false;             // has said good-bye
  bool given_up = false;         // nobody waits for it any more
  std::size_t tasks = 0;         // that it has
  double busy_seconds = 0.0;     // of its threads
  bool owes_answer = false;      // to what it was asked
  Clock::time_point last_heard;  // or when it was asked, where it owed no answer then

  void start_job() {
    ready = false;
    refused = false;
    tasks = 0;
  }

  // Asks for an answer. One that is owed for longer stays so: else a rank would never be lost where jobs are short.
  void ask(Clock::time_point heard_of) {
    if (!owes_answer || heard_of > last_heard) {
      last_heard = Clock::now();
    }
    owes_answer = true;
  }

  void refuse(std::string why) {
    refused = true;
    refusal = std::move(why);
  }

  void heard() {
    last_heard = Clock::now();
    owes_answer = false;
    lost = false;
  }

  // At the end: whether waiting for it is in vain, after it was silent for so long. Kills it where it is on this host
  // and stopped or cut off: it would never end.
  bool should_be_given_up(Clock::duration silent, bool is_cut_off) const;
};

// The median of the last values.
class RunningMedian {
 public:
  void add(double value);
  double value() const;  // 0 where there is none

 private:
  static constexpr std::size_t kKept = 101;
  std::vector<double> values_;
  std::size_t next_ = 0;
};

}  // namespace spincat
