// Some of many, evenly spread over their order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace spincat {

// At most so many of them, in their order.
template <class T>
std::vector<T> evenly_spread(std::span<const T> all, std::size_t most) {
  const std::size_t count = std::min(all.size(), most);
  std::vector<T> some;
  some.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    some.push_back(all[i * all.size() / count]);
  }
  return some;
}

}  // namespace spincat
