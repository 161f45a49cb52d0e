#include "spincat/spin/params.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "spincat/error.h"

namespace spincat {

SpinImageShape SpinImageParams::shape() const {
  const auto w = static_cast<std::size_t>(image_width);
  if (convention == SpinConvention::pcl) {
    return {1, w + 1, 2 * w + 1};
  }
  return {angle_test == AngleTest::soft ? 2U : 1U, w, w};
}

float SpinImageParams::least_cosine() const {
  if (angle_test == AngleTest::soft || support_angle >= 180.0) {
    return -std::numeric_limits<float>::infinity();
  }
  if (support_angle == 90.0) {
    return 0.0F;  // the cosine of the rounded right angle is not
  }
  return static_cast<float>(std::cos(support_angle * std::numbers::pi / 180.0));
}

void SpinImageParams::validate() const {
  check_range("image_width", image_width, kImageWidth);
  check_range("bin_size", bin_size, kBinSize);
  check_range("support_angle", support_angle, kSupportAngle);
  if (convention == SpinConvention::pcl && (binning != Binning::bilinear || angle_test != AngleTest::cutoff)) {
    throw InputError("the pcl convention knows only bilinear binning and the support angle's cutoff");
  }
  if (convention == SpinConvention::pcl && support_angle > 90.0) {
    throw InputError(fmt::format("support_angle {}: expected 0 to 90 in the pcl convention", support_angle));
  }
}

double pcl_bin_size(double search_radius, int image_width) {
  return search_radius / (image_width * std::numbers::sqrt2);
}

}  // namespace spincat
