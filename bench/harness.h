// Timing things against each other on a machine that others use, too.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spincat::bench {

// Seconds since some start: of the clock on the wall, or of all this process' threads on their cores.
inline double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// One of the things to compare. `work` is what one call does, in `unit`s.
struct Contestant {
  std::string name;
  double work;
  std::function<void()> call;
};

struct Timing {
  std::vector<double> wall;  // seconds a call
  std::vector<double> cpu;

  static double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  }
};

// Calls `call` often enough to fill `least` seconds.
inline void time_once(const std::function<void()>& call, double least, Timing& timing) {
  const double wall = seconds(CLOCK_MONOTONIC);
  const double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
  int calls = 0;
  double passed = 0.0;
  while (passed < least) {
    call();
    ++calls;
    passed = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  }
  timing.wall.push_back((seconds(CLOCK_MONOTONIC) - wall) / calls);
  timing.cpu.push_back(passed / calls);
}

// Times the contestants in turn, `rounds` times. For each: work a second by the median and by the best round, by CPU
// time (which others' work disturbs least) and by the wall.
inline nlohmann::ordered_json race(const std::vector<Contestant>& contestants, int rounds, double least = 0.2) {
  std::vector<Timing> timings(contestants.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      time_once(contestants[i].call, least, timings[i]);
    }
  }
  nlohmann::ordered_json result;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const double work = contestants[i].work;
    result[contestants[i].name] = {{"per_second", work / Timing::median(timings[i].cpu)},
                                   {"per_second_best", work / *std::ranges::min_element(timings[i].cpu)},
                                   {"per_second_wall", work / Timing::median(timings[i].wall)}};
  }
  return result;
}

}  // namespace spincat::bench
