// How long something took each time, as counts: percentiles in bounded memory, however long it goes on.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace spincat {

class TimeHistogram {
 public:
  void add(double seconds) {
    ++count_;
    sum_ += seconds;
    longest_ = std::max(longest_, seconds);
    ++bins_[bin_of(seconds)];
  }

  std::uint64_t count() const { return count_; }
  double sum() const { return sum_; }
  double longest() const { return longest_; }
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0; }

  // The time that the share `share` of all times does not exceed, too long by 1 % at most; 0 when there is none.
  double percentile(double share) const {
    if (count_ == 0) {
      return 0.0;
    }
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
      seen += bins_[bin];
      if (seen >= std::max<std::uint64_t>(wanted, 1)) {
        return std::min(longest_, kLeast * std::pow(kStep, static_cast<double>(bin + 1)));
      }
    }
    return longest_;
  }

 private:
  static constexpr double kLeast = 1e-6;  // seconds
  static constexpr double kStep = 1.01;
  static constexpr std::size_t kBins = 2'000;  // up to 440 s

  static std::size_t bin_of(double seconds) {
    if (!(seconds > kLeast)) {
      return 0;
    }
    return std::min(static_cast<std::size_t>(std::log(seconds / kLeast) / std::log(kStep)), kBins - 1);
  }

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double sum_ = 0.0;
  double longest_ = 0.0;
};

}  // namespace spincat
