// The value that a share of some values do not exceed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace spincat {

// The value at place floor(share (n - 1)) of the n values in ascending order. Preconditions: there is one; share is 0
// to 1.
inline double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + place);
  return values[static_cast<std::size_t>(place)];
}

}  // namespace spincat
