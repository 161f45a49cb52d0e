// All SIMD code of the engine. This file is compiled once for each instruction set (Highway's foreach_target includes
// it again and again), and the best one that the machine has is chosen at run time.
//
// Every path computes the same bytes: places are computed by the same single-precision operations in the same order (no
// fused multiply-add), and sums are integers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spincat/spin/kernel.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

#include "spincat/spin/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

constexpr double kUnit = 0x1.0p-23;     // of the sums
constexpr std::int32_t kOne = 1 << 23;  // one, in that unit

// ---- Which groups of points can lie in the support
// -------------------------------------------------------------------

// A spin point, ready for testing bounds: components and their sizes in every lane.
struct Probe {
  explicit Probe(const SpinPoint& point)
      : p{hn::Set(F(), point.x), hn::Set(F(), point.y), hn::Set(F(), point.z)},
        n{hn::Set(F(), point.nx), hn::Set(F(), point.ny), hn::Set(F(), point.nz)},
        size{hn::Abs(n[0]), hn::Abs(n[1]), hn::Abs(n[2])},
        // alpha is a distance only where the normal's length is 1
        is_unit(point.nx * point.nx + point.ny * point.ny + point.nz * point.nz < 1.001F) {}

  VF p[3];
  VF n[3];
  VF size[3];
  bool is_unit;
};

HWY_INLINE VF load(const Bounds& bounds, std::size_t field, std::size_t k) {
  return hn::LoadU(F(), bounds.field[field].data() + k);
}

constexpr float kSlack = 1e-5F;  // many times the rounding error of scan_group, relative to what is rounded

// Which of the N sets of points from k on may hold a point in the support by its place, the angle aside.
HWY_INLINE hn::Mask<F> may_be_near(const Bounds& bounds, std::size_t k, const Support& support, const Probe& probe) {
  const F f;
  VF beta = hn::Zero(f);
  VF beta_half = hn::Zero(f);
  VF squared = hn::Zero(f);
  VF reach = hn::Zero(f);  // at least the distance of any point, by the sum of its components
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const VF d = hn::Sub(load(bounds, Bounds::kX + axis, k), probe.p[axis]);
    const VF half = load(bounds, Bounds::kHalfX + axis, k);
    beta = hn::Add(beta, hn::Mul(probe.n[axis], d));
    beta_half = hn::Add(beta_half, hn::Mul(probe.size[axis], half));
    squared = hn::Add(squared, hn::Mul(d, d));
    reach = hn::Add(reach, hn::Add(hn::Abs(d), half));
  }
  const VF slack = hn::Mul(hn::Set(f, kSlack), reach);
  beta_half = hn::Add(beta_half, slack);
  auto outside = hn::Or(hn::Gt(hn::Sub(beta, beta_half), hn::Set(f, support.most_beta)),
                        hn::Lt(hn::Add(beta, beta_half), hn::Set(f, support.least_beta)));
  if (probe.is_unit) {
    const VF most =
        hn::Add(hn::Sqrt(hn::Set(f, std::max(0.0F, support.most_alpha2))), load(bounds, Bounds::kRadius, k));
    const VF alpha2 = hn::Sub(hn::Sub(squared, hn::Mul(beta, beta)), hn::Mul(slack, reach));
    outside = hn::Or(outside, hn::Gt(alpha2, hn::Mul(hn::Set(f, 1.00001F), hn::Mul(most, most))));
  }
  return hn::Not(outside);
}

// Which of them may hold a point that passes the angle test.
HWY_INLINE hn::Mask<F> may_face(const Bounds& bounds, std::size_t k, const Support& support, const Probe& probe) {
  const F f;
  const VF slack = hn::Set(f, kSlack);
  VF cosine = hn::Zero(f);
  VF cosine_half = slack;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const VF m = load(bounds, Bounds::kNormalX + axis, k);
    const VF m_half = load(bounds, Bounds::kNormalHalfX + axis, k);
    const VF rounding = hn::Mul(slack, hn::Add(hn::Abs(m), m_half));
    cosine = hn::Add(cosine, hn::Mul(probe.n[axis], m));
    cosine_half = hn::Add(cosine_half, hn::Mul(probe.size[axis], hn::Add(m_half, rounding)));
  }
  const VF nearest = support.convention == SpinConvention::pcl ? hn::Abs(cosine) : cosine;
  return hn::Not(hn::Lt(hn::Add(nearest, cosine_half), hn::Set(f, support.least_cosine)));
}

// Which of the N sets of points from k on may hold a point in the support. Never false where a point is accepted by the
// rounded arithmetic of scan_group. Bounds that are no numbers are kept.
HWY_INLINE hn::Mask<F> may_be_seen(const Bounds& bounds, std::size_t k, const Support& support, const Probe& probe) {
  const auto near = may_be_near(bounds, k, support, probe);
  if (!support.tests_angle || hn::AllFalse(F(), near)) {
    return near;
  }
  return hn::And(near, may_face(bounds, k, support, probe));
}

// Writes the numbers of the sets in [first, last) that may be seen to `seen`; returns how many. first is a multiple
// of 16.
HWY_INLINE std::size_t select(const Bounds& bounds, std::size_t first, std::size_t last, const Support& support,
                              const Probe& probe, std::uint32_t* seen) {
  const F f;
  std::size_t count = 0;
  for (std::size_t k = first; k < last; k += hn::Lanes(f)) {
    std::uint8_t bits[16] = {};
    hn::StoreMaskBits(f, may_be_seen(bounds, k, support, probe), bits);
    std::uint64_t left;
    std::memcpy(&left, bits, sizeof(left));
    left &= last - k < 64 ? (std::uint64_t{1} << (last - k)) - 1 : ~std::uint64_t{0};
    for (; left != 0; left &= left - 1) {
      seen[count++] = static_cast<std::uint32_t>(k + hwy::Num0BitsBelowLS1Bit_Nonzero64(left));
    }
  }
  return count;
}

std::size_t select_tiles(const SurfaceGroups& surface, const Support& support, const SpinPoint& p,
                         std::uint32_t* tiles) {
  return select(surface.tile_bounds(), 0, surface.tiles(), support, Probe(p), tiles);
}

// ---- From points to places in the image
// ------------------------------------------------------------------------------

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

// ---- Adding to the sums
// ----------------------------------------------------------------------------------------------

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

// ---- From the sums to the image
// --------------------------------------------------------------------------------------

using L = hn::ScalableTag<std::int64_t>;
using D = hn::RebindToFloat<L>;
using VL = hn::Vec<L>;

// Sums as values of an image, rounded to double and then to float; below zero (by a rounding of u v) as zero. Writes a
// whole vector.
HWY_INLINE void write_values(VL sums, double factor, float* values) {
  const D d;
  const hn::Rebind<float, D> narrow;
  const auto positive = hn::Max(hn::ConvertTo(d, sums), hn::Zero(d));
  hn::StoreU(hn::DemoteTo(narrow, hn::Mul(positive, hn::Set(d, factor))), narrow, values);
}

// The shares that the cells of one row give to their four neighbours, as running arrays with a zero on the left.
struct RowShares {
  static constexpr std::size_t kLeft = 8;  // so that loads at a column, not one to its left, are aligned
  static constexpr std::size_t kRoom = kLeft + 512 + 16;

  alignas(64) std::int64_t here[kRoom];   // (1 - u)(1 - v)
  alignas(64) std::int64_t right[kRoom];  // (1 - u) v
  alignas(64) std::int64_t below[kRoom];  // u (1 - v)
  alignas(64) std::int64_t both[kRoom];   // u v

  // All zero, to the left and to the right of `columns` columns, too.
  void clear(std::size_t columns) {
    for (std::int64_t* shares : {here, right, below, both}) {
      std::fill_n(shares, kLeft + columns + 16, 0);
    }
  }
};

// The sums of the moments 1, u, v, uv of a vector of cells.
struct Moments {
  VL one, u, v, uv;
};

// Those of plain sums. What in_units adds, times the number of points, is 127 times `one`.
HWY_INLINE Moments plain_moments(const std::int64_t* sums) {
  VL one, u, v, uv;
  hn::LoadInterleaved4(L(), sums, one, u, v, uv);
  const VL bias = hn::Sub(hn::ShiftLeft<7>(one), one);
  return {one, hn::Sub(u, bias), hn::Sub(v, bias), hn::Sub(uv, bias)};
}

// Those of weighted sums, given the plain ones of the same cells.
HWY_INLINE Moments weighted_moments(const std::int64_t* sums, const Moments& plain) {
  VL one, u, v, uv;
  hn::LoadInterleaved4(L(), sums, one, u, v, uv);
  const VL bias = hn::Sub(hn::ShiftLeft<7>(plain.one), plain.one);
  return {hn::Sub(one, bias), hn::Sub(u, bias), hn::Sub(v, bias), hn::Sub(uv, bias)};
}

HWY_INLINE Moments difference(const Moments& a, const Moments& b) {
  return {hn::Sub(a.one, b.one), hn::Sub(a.u, b.u), hn::Sub(a.v, b.v), hn::Sub(a.uv, b.uv)};
}

// What a channel of the image is made of.
enum class Channel { plain, weighted, rest };  // rest = plain - weighted

template <Channel kChannel>
HWY_INLINE void split_row(const std::int64_t* sums, std::size_t plane_stride, std::size_t columns, RowShares& row) {
  const L l;
  for (std::size_t j = 0; j < columns; j += hn::Lanes(l)) {
    Moments m = plain_moments(sums + 4 * j);
    if constexpr (kChannel != Channel::plain) {
      const Moments weighted = weighted_moments(sums + plane_stride + 4 * j, m);
      m = kChannel == Channel::weighted ? weighted : difference(m, weighted);
    }
    const VL u_only = hn::Sub(m.u, m.uv);
    const VL v_only = hn::Sub(m.v, m.uv);
    const std::size_t at = RowShares::kLeft + j;
    hn::Store(hn::Sub(hn::Sub(m.one, m.u), v_only), l, row.here + at);
    hn::Store(v_only, l, row.right + at);
    hn::Store(u_only, l, row.below + at);
    hn::Store(m.uv, l, row.both + at);
  }
}

// One channel of an image of rows x columns: each of its values is the sum of the shares of four cells.
struct ImageSize {
  std::size_t rows;
  std::size_t columns;
};

template <Channel kChannel>
void finish_bilinear(const Support& support, const CellLayout& layout, const std::int64_t* cells, double factor,
                     const ImageSize& size, float* image) {
  const L l;
  RowShares rows[2];
  alignas(64) float line[RowShares::kRoom];
  const std::size_t row_numbers = 4 * layout.row_stride;
  rows[0].clear(support.cell_columns);
  rows[1].clear(support.cell_columns);
  for (std::size_t i = 0; i < size.rows; ++i) {
    RowShares& row = rows[i % 2];
    const RowShares& above = rows[(i + 1) % 2];
    if (i < support.cell_rows) {
      split_row<kChannel>(cells + i * row_numbers, layout.plane_stride, support.cell_columns, row);
    } else {
      row.clear(support.cell_columns);
    }
    for (std::size_t j = 0; j < size.columns; j += hn::Lanes(l)) {
      const std::size_t at = RowShares::kLeft + j;
      const VL from_row = hn::Add(hn::Load(l, row.here + at), hn::LoadU(l, row.right + at - 1));
      const VL from_above = hn::Add(hn::Load(l, above.below + at), hn::LoadU(l, above.both + at - 1));
      write_values(hn::Add(from_row, from_above), factor, line + j);
    }
    std::copy_n(line, size.columns, image + i * size.columns);
  }
}

// Every cell is a value already.
void finish_nearest(const Support& support, const CellLayout& layout, const std::int64_t* cells, float* image) {
  const L l;
  const std::size_t columns = support.cell_columns;
  const std::size_t channel = support.cell_rows * columns;
  alignas(64) float line[2][RowShares::kRoom];
  const bool direct = columns % hn::Lanes(l) == 0;  // whole vectors end where the row ends
  for (std::size_t i = 0; i < support.cell_rows; ++i) {
    const std::int64_t* row = cells + i * layout.row_stride * (support.soft ? 2 : 1);
    float* const first = direct ? image + i * columns : line[0];
    float* const second = direct ? image + channel + i * columns : line[1];
    for (std::size_t j = 0; j < columns; j += hn::Lanes(l)) {
      if (support.soft) {
        VL plain, weighted;
        hn::LoadInterleaved2(l, row + 2 * j, plain, weighted);
        weighted = hn::Sub(weighted, hn::Sub(hn::ShiftLeft<7>(plain), plain));
        write_values(weighted, kUnit, first + j);
        write_values(hn::Sub(plain, weighted), kUnit, second + j);
      } else {
        write_values(hn::Load(l, row + j), kUnit, first + j);
      }
    }
    if (direct) {
      continue;
    }
    std::copy_n(line[0], columns, image + i * columns);
    if (support.soft) {
      std::copy_n(line[1], columns, image + channel + i * columns);
    }
  }
}

// The sum over the whole image in the unit of the sums: every accepted point gives one.
double total_of(const CellLayout& layout, const std::int64_t* cells) {
  std::int64_t total = 0;
  for (std::size_t k = 0; k < layout.plane_stride; k += 4) {
    total += cells[k];
  }
  return static_cast<double>(total);
}

void finish(const Support& support, std::int64_t* cells, std::span<float> image) {
  const CellLayout layout(support);
  if (support.binning == Binning::nearest) {
    finish_nearest(support, layout, cells, image.data());
  } else if (support.convention == SpinConvention::pcl) {
    const double total = total_of(layout, cells);
    const ImageSize size{support.cell_rows + 1, support.cell_columns + 1};
    finish_bilinear<Channel::plain>(support, layout, cells, total > 0.0 ? 1.0 / total : 0.0, size, image.data());
  } else {
    const ImageSize size{support.cell_rows, support.cell_columns};
    if (support.soft) {
      finish_bilinear<Channel::weighted>(support, layout, cells, kUnit, size, image.data());
      finish_bilinear<Channel::rest>(support, layout, cells, kUnit, size, image.data() + size.rows * size.columns);
    } else {
      finish_bilinear<Channel::plain>(support, layout, cells, kUnit, size, image.data());
    }
  }
  std::fill_n(cells, layout.size, 0);
}

}  // namespace

SpinKernel kernel() {
  return {"", select_tiles, accumulate, finish};
}

}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdlib>

#include "spincat/error.h"

namespace spincat {
namespace {

HWY_EXPORT(kernel);

struct Path {
  std::string name;
  SpinKernel kernel;
};

std::string path_name(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  for (char& c : name) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (name.starts_with("avx3")) {
    return "avx512";
  }
  return name.starts_with("emu") || name == "scalar" ? "portable" : name;
}

// All paths that were compiled and that this machine can run, the fastest first: Highway numbers the better targets
// lower.
std::vector<Path> find_paths() {
  std::vector<Path> paths;
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  for (std::int64_t left = usable; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    paths.push_back({path_name(target), HWY_DYNAMIC_DISPATCH(kernel)()});
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  for (Path& path : paths) {
    path.kernel.name = path.name;
  }
  return paths;
}

const std::vector<Path>& paths() {
  static const std::vector<Path> all = find_paths();
  return all;
}

}  // namespace

CellLayout::CellLayout(const Support& support)
    : row_stride((support.cell_columns + 7) / 8 * 8), plane_stride(support.cell_rows * row_stride), size(0) {
  const std::size_t numbers = support.binning == Binning::bilinear ? 4 : 1;
  plane_stride *= numbers;
  size = plane_stride * (support.soft ? 2 : 1);
}

const std::vector<std::string>& simd_paths() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Path& path : paths()) {
      all.push_back(path.name);
    }
    return all;
  }();
  return names;
}

const SpinKernel& spin_kernel() {
  const char* wanted = std::getenv("SPINCAT_SIMD");
  if (wanted == nullptr || *wanted == '\0') {
    return paths().front().kernel;
  }
  for (const Path& path : paths()) {
    if (path.name == wanted) {
      return path.kernel;
    }
  }
  throw InputError(
      fmt::format("SPINCAT_SIMD names the path '{}', which is not known or which this machine cannot run "
                  "(one of {})",
                  wanted, fmt::join(simd_paths(), ", ")));
}

}  // namespace spincat
#endif
