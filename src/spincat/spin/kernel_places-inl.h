// Private to spin/kernel.cpp: from points to places in the image.
//
// Included anew for each instruction set, hence the guard that toggles.
#if defined(SPINCAT_SPIN_KERNEL_PLACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPINCAT_SPIN_KERNEL_PLACES_INL_H
#undef SPINCAT_SPIN_KERNEL_PLACES_INL_H
#else
#define SPINCAT_SPIN_KERNEL_PLACES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "spincat/spin/kernel.h"
#include "spincat/spin/kernel_groups-inl.h"
#include "spincat/spin/kernel_vectors-inl.h"
#include "spincat/spin/support.h"
#include "spincat/spin/surface_groups.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {
namespace {

// Points accepted but not yet added to the sums. Room for one vector more than is used.
struct Pending {
  static constexpr std::size_t kRoom = 512;
  static constexpr std::size_t kFull = kRoom - kGroupPoints;  // from here on there is no room for another group
  static constexpr std::size_t kPadded = kRoom + 64;

  alignas(64) float beta[kPadded];
  alignas(64) float alpha2[kPadded];
  alignas(64) float cosine[kPadded];
  alignas(64) std::int32_t cell[kPadded];          // where the cell's sums begin
  alignas(64) std::int32_t shares[4 * kPadded];    // what is added to them
  alignas(64) std::int32_t weighted[4 * kPadded];  // the same, weighted by the squared cosine
};

// Computes alpha^2, beta and the cosine for each point of a group and appends those in the support to the `count`
// points of `pending`; returns how many it has then. The order of the operations is that of the definition.
template <SpinConvention kConvention, bool kSoft, bool kTestsAngle>
HWY_INLINE std::size_t scan_group(const float* group, const Support& support, const Probe& probe, Pending& pending,
                                  std::size_t count) {
  const F f;
  for (std::size_t i = 0; i < kGroupPoints; i += hn::Lanes(f)) {
    const auto load_run = [&](std::size_t run) { return hn::Load(f, group + run * kGroupPoints + i); };
    const auto dot = [&](VF ax, VF ay, VF az, VF bx, VF by, VF bz) {
      return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
    };
    const VF dx = hn::Sub(load_run(0), probe.p[0]);
    const VF dy = hn::Sub(load_run(1), probe.p[1]);
    const VF dz = hn::Sub(load_run(2), probe.p[2]);
    const VF beta = dot(probe.n[0], probe.n[1], probe.n[2], dx, dy, dz);
    const VF squared = dot(dx, dy, dz, dx, dy, dz);
    const VF alpha2 = hn::Sub(squared, hn::Mul(beta, beta));
    auto inside = hn::And(hn::Ge(beta, hn::Set(f, support.least_beta)), hn::Le(beta, hn::Set(f, support.most_beta)));
    inside = hn::AndNot(hn::Gt(alpha2, hn::Set(f, support.most_alpha2)), inside);
    VF cosine = beta;
    if constexpr (kSoft || kTestsAngle) {
      cosine = dot(probe.n[0], probe.n[1], probe.n[2], load_run(3), load_run(4), load_run(5));
    }
    if constexpr (kTestsAngle) {
      const VF tested = kConvention == SpinConvention::pcl ? hn::Abs(cosine) : cosine;
      inside = hn::AndNot(hn::Lt(tested, hn::Set(f, support.least_cosine)), inside);
    }
    if constexpr (kConvention == SpinConvention::pcl) {
      inside = hn::AndNot(hn::Lt(squared, hn::Set(f, support.least_distance2)), inside);
    }
    // To a register and from there to memory: compressing straight to memory is very slow on some processors.
    hn::StoreU(hn::Compress(beta, inside), f, pending.beta + count);
    hn::StoreU(hn::Compress(alpha2, inside), f, pending.alpha2 + count);
    if constexpr (kSoft) {
      hn::StoreU(hn::Compress(cosine, inside), f, pending.cosine + count);
    }
    count += hn::CountTrue(f, inside);
  }
  return count;
}

// The place of N points in the image: the cell, and where in it.
struct Place {
  VF row, column;  // of the cell
  VF u, v;         // in [0, 1]
};

template <SpinConvention kConvention>
HWY_INLINE Place place_of(VF beta, VF alpha2, const Support& support) {
  const F f;
  const VF bins = hn::Set(f, support.bins_per_unit);
  const VF alpha = hn::Sqrt(hn::IfThenElseZero(hn::Gt(alpha2, hn::Zero(f)), alpha2));
  const VF across = hn::Mul(alpha, bins);
  if constexpr (kConvention == SpinConvention::pcl) {
    const VF along = hn::Mul(beta, bins);
    const VF row = hn::Floor(across);
    const VF floor = hn::Floor(along);
    return {row, hn::Add(floor, hn::Set(f, support.width)), hn::Sub(across, row), hn::Sub(along, floor)};
  } else {
    const VF down = hn::Sub(hn::Set(f, 0.5F * support.width), hn::Mul(beta, bins));
    const VF row = hn::Floor(down);
    const VF column = hn::Floor(across);
    return {row, column, hn::Sub(down, row), hn::Sub(across, column)};
  }
}

// `share`, in [0, 1], in the unit of the sums, plus 127 times one (the bits of 1.0F): between 1 and 2 that is what the
// bits of a float count. Much cheaper than a conversion; the biases are taken off the sums.
HWY_INLINE VI in_units(VF share) {
  return hn::BitCast(I(), hn::Add(share, hn::Set(F(), 1.0F)));
}

// factor * index, for an index that is a whole number below 2^23 / factor: what the bits of a float between 2^23 /
// factor and twice that count.
template <std::int32_t kFactor>
HWY_INLINE VI scaled_index(VF index) {
  static_assert(kOne % kFactor == 0);
  const VF low = hn::Set(F(), static_cast<float>(kOne) / kFactor);
  return hn::And(hn::BitCast(I(), hn::Add(index, low)), hn::Set(I(), kOne - 1));
}

// Writes the cells and the shares of a vector of points, one point's four shares after the other's. Transposing within
// blocks of 128 bits is much cheaper than across them, and the order of points does not matter: point 4 b + j goes to
// slot j blocks + b. Not so for the last, incomplete vector, whose points must come first.
class SlotOrder {
 public:
  static constexpr bool kUsed = HWY_TARGET != HWY_SCALAR;

  SlotOrder() : point_(hn::SetTableIndices(I(), points().data())) {}

  HWY_INLINE VI cells(VI in_order, bool complete) const {
    return complete ? hn::TableLookupLanes(in_order, point_) : in_order;
  }

  static HWY_INLINE void store(VI a, VI b, VI c, VI d, bool complete, std::int32_t* shares) {
    const I i;
    if (!complete) {
      hn::StoreInterleaved4(a, b, c, d, i, shares);
      return;
    }
#if HWY_TARGET != HWY_SCALAR  // where vectors have no blocks, none is complete
    const hn::RepartitionToWide<I> wide;
    const auto low_ab = hn::BitCast(wide, hn::InterleaveLower(i, a, b));
    const auto low_cd = hn::BitCast(wide, hn::InterleaveLower(i, c, d));
    const auto high_ab = hn::BitCast(wide, hn::InterleaveUpper(i, a, b));
    const auto high_cd = hn::BitCast(wide, hn::InterleaveUpper(i, c, d));
    const std::size_t lanes = hn::Lanes(i);
    hn::Store(hn::BitCast(i, hn::InterleaveLower(wide, low_ab, low_cd)), i, shares);
    hn::Store(hn::BitCast(i, hn::InterleaveUpper(wide, low_ab, low_cd)), i, shares + lanes);
    hn::Store(hn::BitCast(i, hn::InterleaveLower(wide, high_ab, high_cd)), i, shares + 2 * lanes);
    hn::Store(hn::BitCast(i, hn::InterleaveUpper(wide, high_ab, high_cd)), i, shares + 3 * lanes);
#endif
  }

 private:
  static std::array<std::int32_t, 64> points() {
    std::array<std::int32_t, 64> point{};
    const std::size_t blocks = hn::Lanes(I()) / 4;
    for (std::size_t slot = 0; slot < 4 * blocks; ++slot) {
      point[slot] = static_cast<std::int32_t>(4 * (slot % blocks) + slot / blocks);
    }
    return point;
  }

  decltype(hn::SetTableIndices(I(), static_cast<const std::int32_t*>(nullptr))) point_;
};

// How many sums a cell has.
template <Binning kBinning, bool kSoft>
constexpr std::size_t kSums = kBinning == Binning::bilinear ? 4 : (kSoft ? 2 : 1);

// Fills in the cells and shares of `count` pending points, a vector at a time.
template <SpinConvention kConvention, Binning kBinning, bool kSoft>
HWY_INLINE void place_pending(const Support& support, const CellLayout& layout, Pending& pending, std::size_t count) {
  const F f;
  const I i;
  hn::StoreU(hn::Zero(f), f, pending.beta + count);  // what lies behind the last one is computed but not used
  hn::StoreU(hn::Zero(f), f, pending.alpha2 + count);
  hn::StoreU(hn::Zero(f), f, pending.cosine + count);
  const VF stride = hn::Set(f, static_cast<float>(layout.row_stride));
  const VI one = hn::Set(i, kOne);
  const SlotOrder slots;
  for (std::size_t k = 0; k < count; k += hn::Lanes(f)) {
    const Place at = place_of<kConvention>(hn::Load(f, pending.beta + k), hn::Load(f, pending.alpha2 + k), support);
    const VI cell = scaled_index<kSums<kBinning, kSoft>>(hn::Add(hn::Mul(at.row, stride), at.column));
    const bool complete = kBinning == Binning::bilinear && SlotOrder::kUsed && k + hn::Lanes(f) <= count;
    hn::Store(slots.cells(cell, complete), i, pending.cell + k);
    VF weight = hn::Zero(f);
    if constexpr (kSoft) {
      const VF cosine = hn::Load(f, pending.cosine + k);
      const VF squared = hn::Mul(cosine, cosine);
      weight = hn::IfThenElse(hn::Lt(squared, hn::Set(f, 1.0F)), squared, hn::Set(f, 1.0F));
    }
    if constexpr (kBinning == Binning::bilinear) {
      const VF uv = hn::Mul(at.u, at.v);
      SlotOrder::store(one, in_units(at.u), in_units(at.v), in_units(uv), complete, pending.shares + 4 * k);
      if constexpr (kSoft) {
        SlotOrder::store(in_units(weight), in_units(hn::Mul(weight, at.u)), in_units(hn::Mul(weight, at.v)),
                         in_units(hn::Mul(weight, uv)), complete, pending.weighted + 4 * k);
      }
    } else if constexpr (kSoft) {
      hn::StoreInterleaved2(one, in_units(weight), i, pending.shares + 2 * k);
    }
  }
}

}  // namespace
}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SPINCAT_SPIN_KERNEL_PLACES_INL_H
