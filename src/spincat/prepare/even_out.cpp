#include "spincat/prepare/even_out.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace spincat {
namespace {

constexpr double kCellEdge = 0.04;

// One number for the cell of `p` and the octant of `n`: 20 bits an axis are plenty for coordinates within a few units.
std::uint64_t cell_key(const Vec3& p, const Vec3& n) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = p[axis] / kCellEdge;
    const auto towards_zero = static_cast<std::int64_t>(at);
    const std::int64_t cell = towards_zero - (at < static_cast<double>(towards_zero) ? 1 : 0) + (1 << 19);
    key = (key << 20) | (static_cast<std::uint64_t>(cell) & 0xFFFFFU);
    key = (key << 1) | (n[axis] < 0.0 ? 1U : 0U);
  }
  return key;
}

// For each key how many of the keys are equal to it. A table with open addressing: several times faster than a
// std::unordered_map, which was most of the time of even_out.
std::vector<std::uint32_t> count_equal(const std::vector<std::uint64_t>& keys) {
  const std::size_t size = std::bit_ceil(2 * keys.size() + 1);
  const int shift = std::countl_zero(size - 1);
  std::vector<std::uint32_t> first(size, 0);  // the first key at a place and one more; 0: free
  std::vector<std::uint32_t> counts(keys.size(), 0);
  std::vector<std::uint32_t> of(keys.size());  // the first key that each is equal to
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    // Fibonacci hashing: the upper bits of a product with 2^64 over the golden section.
    std::size_t at = (keys[i] * 0x9E3779B97F4A7C15ULL) >> shift;
    while (first[at] != 0 && keys[first[at] - 1] != keys[i]) {
      at = (at + 1) & (size - 1);
    }
    if (first[at] == 0) {
      first[at] = i + 1;
    }
    of[i] = first[at] - 1;
    ++counts[of[i]];
  }
  std::ranges::transform(of, of.begin(), [&](std::uint32_t i) { return counts[i]; });
  return of;
}

struct Waiting {
  double time;
  std::uint32_t point;
  auto operator<=>(const Waiting&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer
};

// The `count` points that come first, in order, when point i waits for -log(1 - u_i) crowd_i with u_i uniform. Only
// those that can be among them need a logarithm: u <= -log(1 - u) <= u / (1 - u).
std::vector<Waiting> first_to_come(std::span<const std::uint32_t> crowd, std::size_t count, Random& random) {
  std::vector<double> drawn(crowd.size());
  std::vector<double> latest(crowd.size());
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    drawn[i] = random.uniform();
    latest[i] = drawn[i] * crowd[i] / (1.0 - drawn[i]);
  }
  double limit = std::numeric_limits<double>::infinity();
  if (count < crowd.size()) {
    constexpr double kRounding = 1.0 + 1e-9;
    const auto last = latest.begin() + static_cast<std::ptrdiff_t>(count);
    std::ranges::nth_element(latest, last);
    limit = *last * kRounding;
  }
  std::vector<Waiting> order;
  for (std::uint32_t i = 0; i < crowd.size(); ++i) {
    if (drawn[i] * crowd[i] <= limit) {
      order.push_back({-std::log(1.0 - drawn[i]) * crowd[i], i});
    }
  }
  std::ranges::sort(order);
  order.resize(count);
  return order;
}

}  // namespace

SurfacePoints even_out(const SurfacePoints& points, std::size_t count, Random& random) {
  const std::size_t size = points.positions.size();
  std::vector<std::uint64_t> keys(size);
  std::ranges::transform(points.positions, points.normals, keys.begin(), cell_key);
  const std::vector<std::uint32_t> crowd = count_equal(keys);
  // Weighted sampling without replacement (Efraimidis and Spirakis): the smallest of exponential waiting times whose
  // rate is the point's weight, here one over the number of points in its cell.
  const std::vector<Waiting> order = first_to_come(crowd, std::min(count, size), random);
  SurfacePoints drawn;
  for (const Waiting& waiting : order) {
    drawn.positions.push_back(points.positions[waiting.point]);
    drawn.normals.push_back(points.normals[waiting.point]);
  }
  return drawn;
}

}  // namespace spincat
