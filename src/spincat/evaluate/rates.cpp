#include "spincat/evaluate/rates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace spincat {
namespace {

constexpr double kConfidence = 0.95;
constexpr double kNormal95 = 1.959963984540054;  // of the standard normal distribution

std::uint64_t total(const std::vector<std::uint32_t>& row) {
  return std::accumulate(row.begin(), row.end(), std::uint64_t{0});
}

// How many votes were right, and how many there were.
struct Count {
  std::uint64_t right = 0;
  std::uint64_t all = 0;
};

Count counted(const Confusion& confusion) {
  Count count;
  for (std::size_t truth = 0; truth < confusion.size(); ++truth) {
    count.right += confusion[truth][truth];
    count.all += total(confusion[truth]);
  }
  return count;
}

Interval within_bounds(double low, double high) {
  return {std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0)};
}

// P(|T| <= t) of Student's t with a whole number of degrees of freedom: the finite sums of Abramowitz and Stegun,
// 26.7.3 and 26.7.4.
double student_t_inside(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(degrees));
  const double cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1.0;
  double sum = degrees == 1 ? 0.0 : term;
  for (int k = odd ? 3 : 2; k <= degrees - 2; k += 2) {
    term *= cosine * cosine * (k - 1) / k;
    sum += term;
  }
  return odd ? 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

}  // namespace

double mean_class_rate(const Confusion& confusion) {
  double sum = 0.0;
  int tested = 0;
  for (std::size_t truth = 0; truth < confusion.size(); ++truth) {
    if (const auto all = static_cast<double>(total(confusion[truth])); all > 0.0) {
      sum += confusion[truth][truth] / all;
      ++tested;
    }
  }
  return tested > 0 ? sum / tested : 0.0;
}

double overall_rate(const Confusion& confusion) {
  const auto [right, all] = counted(confusion);
  return all > 0 ? static_cast<double>(right) / static_cast<double>(all) : 0.0;
}

Interval wilson_interval(std::uint64_t right, std::uint64_t all) {
  if (all == 0) {
    return {};
  }
  const auto n = static_cast<double>(all);
  const double share = static_cast<double>(right) / n;
  const double z2 = kNormal95 * kNormal95;
  const double centre = share + z2 / (2.0 * n);
  const double half = kNormal95 * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n));
  const double scale = 1.0 + z2 / n;
  return within_bounds((centre - half) / scale, (centre + half) / scale);
}

Rate pooled_overall_rate(const Confusion& confusion) {
  const auto [right, all] = counted(confusion);
  return {overall_rate(confusion), 0.0, wilson_interval(right, all)};
}

Rate pooled_mean_class_rate(const Confusion& confusion) {
  double below = 0.0;
  double above = 0.0;
  int tested = 0;
  for (std::size_t truth = 0; truth < confusion.size(); ++truth) {
    const std::uint64_t all = total(confusion[truth]);
    if (all == 0) {
      continue;
    }
    const double share = static_cast<double>(confusion[truth][truth]) / static_cast<double>(all);
    const Interval interval = wilson_interval(confusion[truth][truth], all);
    below += (share - interval.low) * (share - interval.low);
    above += (interval.high - share) * (interval.high - share);
    ++tested;
  }
  if (tested == 0) {
    return {};
  }
  const double mean = mean_class_rate(confusion);
  return {mean, 0.0, within_bounds(mean - std::sqrt(below) / tested, mean + std::sqrt(above) / tested)};
}

Rate rate_over_splits(std::span<const double> values, double test_share) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) {
    return {mean, 0.0, {}};
  }
  double squares = 0.0;
  for (const double v : values) {
    squares += (v - mean) * (v - mean);
  }
  const double variance = squares / (n - 1.0);
  const double half = student_t_95(static_cast<int>(values.size()) - 1) *
                      std::sqrt(variance * (1.0 / n + test_share / (1.0 - test_share)));
  return {mean, std::sqrt(variance), within_bounds(mean - half, mean + half)};
}

double student_t_95(int degrees) {
  double low = 0.0;
  double high = 13.0;  // 12.706 for one degree, and less for more
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_inside(middle, degrees) < kConfidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace spincat
