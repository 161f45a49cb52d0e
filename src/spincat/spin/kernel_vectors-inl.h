// Private to spin/kernel.cpp: the vectors of all SIMD code, and the unit of the sums.
//
// Included anew for each instruction set, hence the guard that toggles.
#if defined(SPINCAT_SPIN_KERNEL_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPINCAT_SPIN_KERNEL_VECTORS_INL_H
#undef SPINCAT_SPIN_KERNEL_VECTORS_INL_H
#else
#define SPINCAT_SPIN_KERNEL_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

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

}  // namespace
}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SPINCAT_SPIN_KERNEL_VECTORS_INL_H
