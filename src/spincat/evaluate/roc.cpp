#include "spincat/evaluate/roc.h"

#include <algorithm>
#include <vector>

namespace spincat {

double area_under_curve(std::span<const double> positives, std::span<const double> negatives) {
  if (positives.empty() || negatives.empty()) {
    return 0.5;
  }
  std::vector<double> below(negatives.begin(), negatives.end());
  std::ranges::sort(below);
  double wins = 0.0;
  for (const double value : positives) {
    const auto [first, last] = std::ranges::equal_range(below, value);
    wins += static_cast<double>(first - below.begin()) + 0.5 * static_cast<double>(last - first);
  }
  return wins / (static_cast<double>(positives.size()) * static_cast<double>(negatives.size()));
}

}  // namespace spincat
