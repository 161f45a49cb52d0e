#include "spincat/parallel/farm_ranks.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "spincat/parallel/process_state.h"

namespace spincat {
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

}  // namespace spincat
