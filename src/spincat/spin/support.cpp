#include "spincat/spin/support.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace spincat {
namespace {

// Finite floats in rising order, numbered without gaps: 0 is 0.
float nth_float(std::int64_t n) {
  return n >= 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(n))
                : -std::bit_cast<float>(static_cast<std::uint32_t>(-n));
}

// The greatest finite float for which `holds`, given that it holds for the smallest floats and from some float on no
// more; minus infinity when it never holds.
template <class Predicate>
float last_where(Predicate holds) {
  const std::int64_t greatest = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max());
  std::int64_t yes = -greatest - 1;
  std::int64_t no = greatest + 1;
  while (no - yes > 1) {
    const std::int64_t middle = yes + (no - yes) / 2;
    (holds(nth_float(middle)) ? yes : no) = middle;
  }
  return yes < -greatest ? -std::numeric_limits<float>::infinity() : nth_float(yes);
}

}  // namespace

Support::Support(const SpinImageParams& params)
    : convention(params.convention),
      binning(params.binning),
      soft(params.angle_test == AngleTest::soft),
      width(static_cast<float>(params.image_width)),
      bins_per_unit(static_cast<float>(1.0 / params.bin_size)),
      least_cosine(params.least_cosine()),
      least_distance2(0.0F),
      cell_rows(static_cast<std::size_t>(params.image_width)),
      cell_columns(static_cast<std::size_t>(params.image_width)) {
  const float w = width;
  const float bins = bins_per_unit;
  most_alpha2 = last_where([=](float a) { return std::sqrt(a > 0.0F ? a : 0.0F) * bins < w; });
  if (convention == SpinConvention::pcl) {
    constexpr float kSamePoint = 10.0F * static_cast<float>(std::numeric_limits<double>::epsilon());
    tests_angle = least_cosine > 0.0F;
    most_beta = last_where([=](float beta) { return beta * bins < w; });
    least_beta = -most_beta;
    least_distance2 = std::nextafter(last_where([](float d) { return d < 0.0F || std::sqrt(d) < kSamePoint; }), 1.0F);
    cell_columns *= 2;
  } else {
    tests_angle = !std::isinf(least_cosine);
    most_beta = last_where([=](float beta) { return 0.5F * w - beta * bins >= 0.0F; });
    least_beta = -last_where([=](float beta) { return 0.5F * w + beta * bins < w; });
  }
}

}  // namespace spincat
