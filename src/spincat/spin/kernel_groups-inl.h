// Private to spin/kernel.cpp: which groups of points can lie in the support of a spin point.
//
// Included anew for each instruction set, hence the guard that toggles.
#if defined(SPINCAT_SPIN_KERNEL_GROUPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPINCAT_SPIN_KERNEL_GROUPS_INL_H
#undef SPINCAT_SPIN_KERNEL_GROUPS_INL_H
#else
#define SPINCAT_SPIN_KERNEL_GROUPS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "spincat/spin/kernel.h"
#include "spincat/spin/kernel_vectors-inl.h"
#include "spincat/spin/support.h"
#include "spincat/spin/surface_groups.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {
namespace {

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

}  // namespace
}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SPINCAT_SPIN_KERNEL_GROUPS_INL_H
