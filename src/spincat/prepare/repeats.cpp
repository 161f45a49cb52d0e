#include "spincat/prepare/repeats.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace spincat {

std::vector<std::uint32_t> first_at_position(std::span<const Vec3> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(points[a].data(), points[a].data() + 3, points[b].data(), points[b].data() + 3);
  });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::vector<std::uint32_t> measured_points(std::span<const Vec3> points) {
  const auto is_zero = [](const Vec3& p) { return p.isZero(0.0); };
  const auto zeros = static_cast<std::size_t>(std::ranges::count_if(points, is_zero));
  std::vector<std::uint32_t> measured(points.size());
  std::iota(measured.begin(), measured.end(), 0U);
  if (zeros > 1 && zeros < points.size()) {
    std::erase_if(measured, [&](std::uint32_t i) { return is_zero(points[i]); });
  }
  return measured;
}

bool all_at_one_place(std::span<const Vec3> points) {
  return std::ranges::all_of(points, [&](const Vec3& p) { return p == points[0]; });
}

}  // namespace spincat
