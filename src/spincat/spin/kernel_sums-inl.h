// Private to spin/kernel.cpp: what the points of an image give to its sums.
//
// Included anew for each instruction set, hence the guard that toggles.
#if defined(SPINCAT_SPIN_KERNEL_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPINCAT_SPIN_KERNEL_SUMS_INL_H
#undef SPINCAT_SPIN_KERNEL_SUMS_INL_H
#else
#define SPINCAT_SPIN_KERNEL_SUMS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "spincat/spin/kernel.h"
#include "spincat/spin/kernel_groups-inl.h"
#include "spincat/spin/kernel_places-inl.h"
#include "spincat/spin/kernel_vectors-inl.h"
#include "spincat/spin/support.h"
#include "spincat/spin/surface_groups.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {
namespace {

// Adds kNumbers shares to as many sums at once.
template <std::size_t kNumbers>
HWY_INLINE void add_contributions(const std::int32_t* shares, std::int64_t* sums) {
  const hn::CappedTag<std::int64_t, kNumbers> d;
  const hn::Rebind<std::int32_t, decltype(d)> narrow;
  for (std::size_t k = 0; k < kNumbers; k += hn::Lanes(d)) {
    hn::StoreU(hn::Add(hn::LoadU(d, sums + k), hn::PromoteTo(d, hn::LoadU(narrow, shares + k))), d, sums + k);
  }
}

// The points are taken from kStreams places of the list in turn, so that those of one group come one by one.
template <std::size_t kNumbers>
HWY_INLINE void scatter(const std::int32_t* cell, const std::int32_t* shares, std::size_t count, std::int64_t* cells) {
  constexpr std::size_t kStreams = 8;
  const std::size_t length = count / kStreams;
  const auto add = [&](std::size_t k) {
    std::int64_t* sums = cells + static_cast<std::uint32_t>(cell[k]);
    if constexpr (kNumbers == 1) {
      *sums += kOne;
    } else {
      add_contributions<kNumbers>(shares + kNumbers * k, sums);
    }
  };
  for (std::size_t k = 0; k < length; ++k) {
    for (std::size_t stream = 0; stream < kStreams; ++stream) {
      add(stream * length + k);
    }
  }
  for (std::size_t k = kStreams * length; k < count; ++k) {
    add(k);
  }
}

template <SpinConvention kConvention, Binning kBinning, bool kSoft>
HWY_INLINE void add_pending(const Support& support, const CellLayout& layout, Pending& pending, std::size_t count,
                            std::int64_t* cells) {
  place_pending<kConvention, kBinning, kSoft>(support, layout, pending, count);
  scatter<kSums<kBinning, kSoft>>(pending.cell, pending.shares, count, cells);
  if constexpr (kBinning == Binning::bilinear && kSoft) {
    scatter<4>(pending.cell, pending.weighted, count, cells + layout.plane_stride);
  }
}

// A step through a list that visits all of it, each time far from the last few places: the golden section of its
// length.
std::size_t far_step(std::size_t length) {
  auto step = static_cast<std::size_t>(0.618 * static_cast<double>(length));
  while (std::gcd(step, length) > 1) {
    ++step;
  }
  return std::max<std::size_t>(step, 1);
}

// Groups are taken in an order that jumps about: neighbours fall into the same cells, and an addition to a cell must
// wait for the one before.
template <SpinConvention kConvention, Binning kBinning, bool kSoft, bool kTestsAngle>
void accumulate_as(const SurfaceGroups& surface, const Support& support, const SpinPoint& p,
                   std::span<const std::uint32_t> tiles, std::int64_t* cells) {
  const CellLayout layout(support);
  const Probe probe(p);
  Pending pending;
  std::array<std::uint32_t, kTilesAtOnce * kTileGroups> seen;
  std::size_t count = 0;
  for (const std::uint32_t tile : tiles) {
    const std::size_t first = tile * kTileGroups;
    const std::size_t last = std::min(first + kTileGroups, surface.groups());
    count += select(surface.group_bounds(), first, last, support, probe, seen.data() + count);
  }
  const std::size_t step = far_step(count);
  std::size_t accepted = 0;
  for (std::size_t k = 0, at = 0; k < count; ++k, at = at + step < count ? at + step : at + step - count) {
    accepted = scan_group<kConvention, kSoft, kTestsAngle>(surface.group(seen[at]), support, probe, pending, accepted);
    if (accepted > Pending::kFull) {
      add_pending<kConvention, kBinning, kSoft>(support, layout, pending, accepted, cells);
      accepted = 0;
    }
  }
  add_pending<kConvention, kBinning, kSoft>(support, layout, pending, accepted, cells);
}

void accumulate(const SurfaceGroups& surface, const Support& support, const SpinPoint& p,
                std::span<const std::uint32_t> tiles, std::int64_t* cells) {
  using enum Binning;
  constexpr SpinConvention kJohnson = SpinConvention::johnson;
  constexpr SpinConvention kPcl = SpinConvention::pcl;
  const bool angle = support.tests_angle;
  auto* variant = accumulate_as<kJohnson, bilinear, false, false>;
  if (support.convention == kPcl) {
    variant = angle ? accumulate_as<kPcl, bilinear, false, true> : accumulate_as<kPcl, bilinear, false, false>;
  } else if (support.binning == nearest) {
    variant = support.soft ? accumulate_as<kJohnson, nearest, true, false>
              : angle      ? accumulate_as<kJohnson, nearest, false, true>
                           : accumulate_as<kJohnson, nearest, false, false>;
  } else if (support.soft) {
    variant = accumulate_as<kJohnson, bilinear, true, false>;
  } else if (angle) {
    variant = accumulate_as<kJohnson, bilinear, false, true>;
  }
  variant(surface, support, p, tiles, cells);
}

}  // namespace
}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SPINCAT_SPIN_KERNEL_SUMS_INL_H
