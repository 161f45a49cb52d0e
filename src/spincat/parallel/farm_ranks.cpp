#include "spincat/parallel/farm_ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <thread>

#include "spincat/error.h"
#include "spincat/parallel/heartbeat.h"
#include "spincat/parallel/pause.h"
#include "spincat/parallel/process_state.h"

namespace spincat {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{1} << 30;   // bytes to one rank; then it is told nothing more
constexpr std::size_t kMostForLost = std::size_t{64} << 20;  // the same: it may be there again soon

}  // namespace

bool TaskFarm::Rank::should_be_given_up(Clock::duration silent, bool is_cut_off) const {
  if (farm::has_gone(greeting)) {
    return true;
  }
  const bool in_sight = farm::is_in_our_sight(greeting);
  const bool stopped = in_sight && is_stopped(greeting.process) && silent > std::chrono::milliseconds(500);
  if (in_sight && (stopped || is_cut_off) && runs_our_program(greeting.process)) {
    ::kill(static_cast<pid_t>(greeting.process), SIGKILL);
  }
  return stopped || is_cut_off || silent > silence_deadline() * (lost ? 1 : 10);
}

std::chrono::duration<double> silence_deadline() {
  const char* wanted = std::getenv("SPINCAT_DEADLINE");
  const double seconds = wanted != nullptr ? std::atof(wanted) : 0.0;
  return std::chrono::duration<double>(seconds > 0.0 ? seconds : 2.0);
}

void RunningMedian::add(double value) {
  if (values_.size() < kKept) {
    values_.push_back(value);
  } else {
    values_[next_++ % kKept] = value;
  }
}

double RunningMedian::value() const {
  if (values_.empty()) {
    return 0.0;
  }
  std::vector<double> sorted = values_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

// Whether the rank takes what it is told: one that is slow, stopped or lost must not cost all our memory.
bool TaskFarm::tell(std::size_t other, int tag, const SharedBytes& bytes) {
  const Rank& rank = others_[other];
  const int number = static_cast<int>(other) + 1;
  if (ranks_.bytes_waiting(number) > (rank.lost ? kMostForLost : kMostWaiting)) {
    return false;
  }
  ranks_.send(number, tag, bytes);
  return true;
}

// What a job begins with; each rank answers it.
void TaskFarm::ask(std::size_t other, const SharedBytes& job) {
  if (tell(other, farm::kJob, job)) {
    others_[other].ask(ranks_.heard(static_cast<int>(other) + 1));
  } else {
    others_[other].refuse("it does not take what it is sent");
  }
}

void TaskFarm::say_to_all(int tag, const SharedBytes& bytes) {
  for (int r = 1; r < ranks_.size(); ++r) {
    ranks_.send(r, tag, bytes);
  }
}

// Learns who a rank is, or that it has gone.
void TaskFarm::greet(Rank& rank, const Message& message) {
  if (message.tag == farm::kHello) {
    rank.greeting = unpack<farm::Greeting>(message.bytes);
    const farm::Greeting own = farm::own_greeting();
    if (rank.greeting.protocol != own.protocol || rank.greeting.program != own.program) {
      throw RunError(fmt::format("rank {} runs {}, rank 0 another version: all hosts need the same program",
                                 message.from, rank.greeting.program));
    }
  } else if (message.tag == farm::kBye) {
    rank.left = true;
  }
}

// When the work is over, whatever is wrong with a rank costs nothing any more.
void TaskFarm::greet_late(Rank& rank, const Message& message) {
  try {
    greet(rank, message);
  } catch (const std::exception&) {
    return;
  }
}

// None may leave before all can: MPI ends well only where all come to its end together.
void TaskFarm::dismiss() {
  say_to_all(farm::kQuit, to_send({}));
  for (Rank& rank : others_) {
    rank.last_heard = Clock::now();
  }
  auto last_look = Clock::now();
  Pause pause;
  const auto here = [](const Rank& rank) { return !rank.left && !rank.given_up; };
  while (std::ranges::any_of(others_, here)) {
    bool heard = false;
    while (const std::optional<Message> message = ranks_.receive()) {
      heard = true;
      Rank& rank = others_[static_cast<std::size_t>(message->from) - 1];
      rank.heard();
      greet_late(rank, *message);
    }
    const auto now = Clock::now();
    const bool stalled = now - last_look > kStall;
    last_look = now;
    for (std::size_t r = 0; r < others_.size(); ++r) {
      Rank& rank = others_[r];
      const int number = static_cast<int>(r) + 1;
      rank.last_heard = stalled ? now : std::max(rank.last_heard, ranks_.heard(number));
      if (here(rank) && rank.should_be_given_up(now - rank.last_heard, ranks_.is_cut_off(number))) {
        rank.given_up = true;
        ranks_.send(number, farm::kEnd, to_send({}));  // in case it still hears
        ranks_.give_up(number);
      }
    }
    std::this_thread::sleep_for(pause.after({.happened = heard}));
  }
  heartbeat_.reset();  // the next is the last word
  say_to_all(farm::kEnd, to_send({}));
}

}  // namespace spincat
