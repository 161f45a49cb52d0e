#include "spincat/spin/surface_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "spincat/spin/in_order.h"

namespace spincat {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Half edges are rounded up by more than their own rounding error.
constexpr float kRoundUp = 1.0F + 1e-6F;

std::size_t divided_up(std::size_t a, std::size_t b) {
  return (a + b - 1) / b;
}

struct Interval {
  float low = kInfinity;
  float high = -kInfinity;
  bool has_nan = false;
};

// The interval of the numbers among `values`. In sixteen running intervals, which a compiler turns into vectors.
Interval interval_of(std::span<const float> values) {
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> low;
  std::array<float, kLanes> high;
  std::array<std::int32_t, kLanes> nan{};
  low.fill(kInfinity);
  high.fill(-kInfinity);
  const auto widen = [&](std::size_t k, float v) {
    low[k] = v < low[k] ? v : low[k];
    high[k] = v > high[k] ? v : high[k];
    nan[k] |= v != v ? 1 : 0;
  };
  const std::size_t whole = values.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      widen(k, values[i + k]);
    }
  }
  for (std::size_t i = whole; i < values.size(); ++i) {
    widen(i - whole, values[i]);
  }
  Interval all;
  for (std::size_t k = 0; k < kLanes; ++k) {
    all.low = low[k] < all.low ? low[k] : all.low;
    all.high = high[k] > all.high ? high[k] : all.high;
    all.has_nan = all.has_nan || nan[k] != 0;
  }
  return all;
}

void set_interval(Bounds& bounds, std::size_t centre, std::size_t half, std::size_t k, const Interval& all) {
  const float middle = 0.5F * all.low + 0.5F * all.high;
  bounds.field[centre][k] = middle;
  bounds.field[half][k] = std::max(all.high - middle, middle - all.low) * kRoundUp;
}

Interval get_interval(const Bounds& bounds, std::size_t centre, std::size_t half, std::size_t k) {
  const float m = bounds.field[centre][k];
  const float h = bounds.field[half][k] * kRoundUp;
  return {m - h, m + h};
}

void set_radius(Bounds& bounds, std::size_t k) {
  const auto half = [&](std::size_t axis) { return bounds.field[Bounds::kHalfX + axis][k]; };
  bounds.field[Bounds::kRadius][k] = std::sqrt(half(0) * half(0) + half(1) * half(1) + half(2) * half(2)) * kRoundUp;
}

// Bounds of one group of points. A position that is no number lies in no support and needs no bounds; a normal that is
// none passes every angle test and can have none.
void bound_group(Bounds& bounds, std::size_t g, const float* points) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Interval position = interval_of({points + axis * kGroupPoints, kGroupPoints});
    const Interval normal = interval_of({points + (3 + axis) * kGroupPoints, kGroupPoints});
    set_interval(bounds, Bounds::kX + axis, Bounds::kHalfX + axis, g, position);
    set_interval(bounds, Bounds::kNormalX + axis, Bounds::kNormalHalfX + axis, g,
                 normal.has_nan ? Interval{kNaN, kNaN} : normal);
  }
  set_radius(bounds, g);
}

// Bounds of a tile from those of its groups [first, last).
void bound_tile(Bounds& bounds, std::size_t t, const Bounds& groups, std::size_t first, std::size_t last) {
  constexpr std::array<std::array<std::size_t, 2>, 2> kBoxes = {
      {{Bounds::kX, Bounds::kHalfX}, {Bounds::kNormalX, Bounds::kNormalHalfX}}};
  for (const auto& [centre, half] : kBoxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Interval all;
      bool known = true;
      for (std::size_t g = first; g < last; ++g) {
        const Interval one = get_interval(groups, centre + axis, half + axis, g);
        known = known && !std::isnan(one.low);
        all.low = std::min(all.low, one.low);
        all.high = std::max(all.high, one.high);
      }
      set_interval(bounds, centre + axis, half + axis, t, known ? all : Interval{kNaN, kNaN});
    }
  }
  set_radius(bounds, t);
}

// Every third bit of the result, from the lowest, is a bit of v (at most 10 bits).
std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | (v << 16)) & 0x030000FFU;
  v = (v | (v << 8)) & 0x0300F00FU;
  v = (v | (v << 4)) & 0x030C30C3U;
  v = (v | (v << 2)) & 0x09249249U;
  return v;
}

}  // namespace

Bounds::Bounds(std::size_t count) : size(count) {
  for (AlignedFloats& values : field) {
    values.assign(divided_up(count, 16) * 16, 0.0F);
  }
}

SurfaceGroups::SurfaceGroups(const OrientedPoints& surface, const Support& support, int threads)
    : group_bounds_(divided_up(surface.size(), kGroupPoints)),
      tile_bounds_(divided_up(group_bounds_.size, kTileGroups)),
      points_(groups() * 6 * kGroupPoints) {
  choose_cells(surface);
  std::vector<std::uint32_t> order;
  if (sees_everything(support)) {
    order.resize(surface.size());
    std::iota(order.begin(), order.end(), 0U);
  } else {
    order = curve_order(surface);
  }
  constexpr std::size_t kTilesOfThread = 4;  // fewer are done before another thread has started
  const std::size_t workers =
      std::clamp<std::size_t>(tiles() / kTilesOfThread, 1, static_cast<std::size_t>(std::max(threads, 1)));
  const std::size_t share = divided_up(tiles(), workers);
  for_each_step(workers, workers, [&](std::size_t step, std::size_t) {
    for (std::size_t t = step * share; t < std::min((step + 1) * share, tiles()); ++t) {
      fill_tile(t, surface, order);
    }
  });
}

// The points of a tile and the bounds around them.
void SurfaceGroups::fill_tile(std::size_t t, const OrientedPoints& surface, std::span<const std::uint32_t> order) {
  const std::size_t first = t * kTileGroups;
  const std::size_t last = std::min(first + kTileGroups, groups());
  for (std::size_t g = first; g < last; ++g) {
    const std::size_t begin = g * kGroupPoints;
    copy_group(g, surface, order.subspan(begin, std::min(kGroupPoints, order.size() - begin)));
    bound_group(group_bounds_, g, group(g));
  }
  bound_tile(tile_bounds_, t, group_bounds_, first, last);
}

// Cells of the curve: cubes, about one for every eight points that a surface (not a volume) puts into them.
void SurfaceGroups::choose_cells(const OrientedPoints& surface) {
  float edge = 0.0F;
  const std::array<std::span<const float>, 3> positions = {surface.x(), surface.y(), surface.z()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Interval all = interval_of(positions[axis]);
    axes_[axis].low = all.low;
    diagonal_ = std::hypot(diagonal_, all.high - all.low);
    edge = std::max(edge, all.high - all.low);
  }
  while (bits_ < 8 && (std::size_t{1} << (2 * bits_)) * 16 < surface.size()) {
    ++bits_;
  }
  for (Axis& axis : axes_) {
    axis.cells_per_unit = edge > 0.0F ? static_cast<float>(1U << bits_) / edge : 0.0F;
    axis.last = static_cast<float>((1U << bits_) - 1U);
  }
}

// Whether hardly a group would be left out: no angle test, and a support as large as the surface (or so few points that
// sorting them costs more than it saves).
bool SurfaceGroups::sees_everything(const Support& support) const {
  const float reach = std::min(support.most_beta, std::sqrt(std::max(0.0F, support.most_alpha2)));
  return !support.tests_angle && (reach >= 0.5F * diagonal_ || tiles() <= 1);
}

// The cell along one axis. A position that is no number goes to the first cell, one that is outside to the nearest.
std::uint32_t SurfaceGroups::Axis::cell(float v) const {
  const float c = (v - low) * cells_per_unit;
  const float inside = c > 0.0F ? c : 0.0F;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(inside < last ? inside : last));
}

std::uint32_t SurfaceGroups::curve_key(float x, float y, float z) const {
  return spread_bits(axes_[0].cell(x)) | (spread_bits(axes_[1].cell(y)) << 1) | (spread_bits(axes_[2].cell(z)) << 2);
}

// One axis after the other, in loops that a compiler turns into vectors.
std::vector<std::uint32_t> SurfaceGroups::curve_keys(const OrientedPoints& surface) const {
  std::vector<std::uint32_t> keys(surface.size(), 0U);
  const std::array<std::span<const float>, 3> positions = {surface.x(), surface.y(), surface.z()};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const Axis of = axes_[axis];
    const float* from = positions[axis].data();
    std::uint32_t* to = keys.data();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      to[i] |= spread_bits(of.cell(from[i])) << axis;
    }
  }
  return keys;
}

// Radix sort by the key, from the lowest digit up: stable, so the order is a function of the surface alone.
std::vector<std::uint32_t> SurfaceGroups::curve_order(const OrientedPoints& surface) const {
  struct Keyed {
    std::uint32_t key;
    std::uint32_t point;
  };
  constexpr unsigned kDigit = 9;  // bits
  constexpr std::uint32_t kMask = (1U << kDigit) - 1U;
  const std::vector<std::uint32_t> keys = curve_keys(surface);
  std::vector<Keyed> sorted(keys.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    sorted[i] = {keys[i], i};
  }
  std::vector<Keyed> other(sorted.size());
  for (unsigned shift = 0; shift < 3 * bits_; shift += kDigit) {
    std::array<std::uint32_t, kMask + 2> place{};
    for (const Keyed& it : sorted) {
      ++place[((it.key >> shift) & kMask) + 1];
    }
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const Keyed& it : sorted) {
      other[place[(it.key >> shift) & kMask]++] = it;
    }
    sorted.swap(other);
  }
  std::vector<std::uint32_t> order(sorted.size());
  std::ranges::transform(sorted, order.begin(), &Keyed::point);
  return order;
}

void SurfaceGroups::copy_group(std::size_t g, const OrientedPoints& surface, std::span<const std::uint32_t> points) {
  const std::array<std::span<const float>, 6> arrays = {surface.x(),  surface.y(),  surface.z(),
                                                        surface.nx(), surface.ny(), surface.nz()};
  float* group = points_.data() + 6 * g * kGroupPoints;
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      group[k * kGroupPoints + i] = arrays[k][points[i]];
    }
  }
  // Places left over repeat the last normal, so that they widen no bound.
  for (std::size_t k = 0; k < 6; ++k) {
    float* run = group + k * kGroupPoints;
    std::fill_n(run + points.size(), kGroupPoints - points.size(), k < 3 ? kNaN : run[points.size() - 1]);
  }
}

}  // namespace spincat
