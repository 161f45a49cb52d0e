#include "spincat/spin/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace spincat {
namespace {

// Where a surface point lies as seen from an oriented point: the two coordinates of a spin image.
struct SpinCoordinates {
  float alpha;     // distance from the normal's line            (paper, eq. 1)
  float beta;      // signed height above the tangent plane      (paper, eq. 2)
  float cosine;    // between the two normals
  float distance;  // between the two points
};

SpinCoordinates spin_coordinates(const OrientedPoints& surface, std::size_t s, const OrientedPoints& spin_points,
                                 std::size_t k) {
  const Eigen::Vector3f n = spin_points.normal(k);
  const Eigen::Vector3f m = surface.normal(s);
  const Eigen::Vector3f d = surface.position(s) - spin_points.position(k);
  // The order of these sums is part of the definition: ((x + y) + z).
  const float beta = n.x() * d.x() + n.y() * d.y() + n.z() * d.z();
  const float squared = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
  const float cosine = n.x() * m.x() + n.y() * m.y() + n.z() * m.z();
  return {std::sqrt(std::max(0.0F, squared - beta * beta)), beta, cosine, std::sqrt(squared)};
}

// An image under construction: sums in double, taps that fall outside are dropped.
class Histogram {
 public:
  explicit Histogram(const SpinImageShape& shape) : shape_(shape), sums_(shape.size(), 0.0) {}

  void add(std::size_t channel, long row, long column, double weight) {
    if (row >= 0 && column >= 0 && row < static_cast<long>(shape_.rows) && column < static_cast<long>(shape_.columns)) {
      sums_[(channel * shape_.rows + row) * shape_.columns + column] += weight;
    }
  }

  // Weight `weight` at the place (row + u, column + v), 0 <= u, v <= 1.
  void add_bilinear(std::size_t channel, long row, long column, float u, float v, double weight) {
    add(channel, row, column, weight * ((1.0 - u) * (1.0 - v)));
    add(channel, row + 1, column, weight * (u * (1.0 - v)));
    add(channel, row, column + 1, weight * ((1.0 - u) * v));
    add(channel, row + 1, column + 1, weight * (static_cast<double>(u) * v));
  }

  void write(std::span<float> image, double divisor) const {
    std::transform(sums_.begin(), sums_.end(), image.begin(),
                   [=](double sum) { return static_cast<float>(sum / divisor); });
  }

  double total() const {
    double sum = 0.0;
    for (const double value : sums_) {
      sum += value;
    }
    return sum;
  }

 private:
  SpinImageShape shape_;
  std::vector<double> sums_;
};

void johnson_image(const OrientedPoints& surface, const OrientedPoints& spin_points, std::size_t k,
                   const SpinImageParams& params, std::span<float> image) {
  const auto width = static_cast<float>(params.image_width);
  const auto bins_per_unit = static_cast<float>(1.0 / params.bin_size);
  const bool soft = params.angle_test == AngleTest::soft;
  const float least_cosine = params.least_cosine();
  Histogram histogram(params.shape());
  for (std::size_t s = 0; s < surface.size(); ++s) {
    const SpinCoordinates at = spin_coordinates(surface, s, spin_points, k);
    if (at.cosine < least_cosine) {
      continue;
    }
    const float row = 0.5F * width - at.beta * bins_per_unit;
    const float column = at.alpha * bins_per_unit;
    if (!(row >= 0.0F && row < width && column < width)) {
      continue;
    }
    const auto i = static_cast<long>(row);
    const auto j = static_cast<long>(column);
    const float squared_cosine = std::min(1.0F, at.cosine * at.cosine);
    for (std::size_t channel = 0; channel < params.shape().channels; ++channel) {
      const double weight = !soft ? 1.0 : channel == 0 ? squared_cosine : 1.0F - squared_cosine;
      if (params.binning == Binning::bilinear) {
        histogram.add_bilinear(channel, i, j, row - static_cast<float>(i), column - static_cast<float>(j), weight);
      } else {
        histogram.add(channel, i, j, weight);
      }
    }
  }
  histogram.write(image, 1.0);
}

void pcl_image(const OrientedPoints& surface, const OrientedPoints& spin_points, std::size_t k,
               const SpinImageParams& params, std::span<float> image) {
  const auto width = static_cast<float>(params.image_width);
  const auto bins_per_unit = static_cast<float>(1.0 / params.bin_size);
  const float least_cosine = params.least_cosine();
  constexpr float kSamePoint = 10.0F * static_cast<float>(std::numeric_limits<double>::epsilon());
  Histogram histogram(params.shape());
  for (std::size_t s = 0; s < surface.size(); ++s) {
    const SpinCoordinates at = spin_coordinates(surface, s, spin_points, k);
    const float a = at.alpha * bins_per_unit;
    const float b = at.beta * bins_per_unit;
    if (std::abs(at.cosine) < least_cosine || at.distance < kSamePoint || !(std::abs(b) < width && a < width)) {
      continue;
    }
    const auto i = static_cast<long>(a);
    const auto j = static_cast<long>(std::floor(b));
    histogram.add_bilinear(0, i, j + params.image_width, a - static_cast<float>(i), b - static_cast<float>(j), 1.0);
  }
  // PCL divides by the sum; where every neighbour was rejected it divides by zero, and here the image stays zero.
  const double total = histogram.total();
  histogram.write(image, total > 0.0 ? total : 1.0);
}

}  // namespace

void spin_image_reference(const OrientedPoints& surface, const OrientedPoints& spin_points, std::size_t k,
                          const SpinImageParams& params, std::span<float> image) {
  if (params.convention == SpinConvention::pcl) {
    pcl_image(surface, spin_points, k, params, image);
  } else {
    johnson_image(surface, spin_points, k, params, image);
  }
}

}  // namespace spincat
