// Spin images of points in memory: a cylinder's, and how alike those of its side and of its lid are.
#include <spincat/spincat.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <numbers>
#include <span>

namespace {

// A point cloud without normals, as a scanner gives one: 40 rings of a cylinder's side, then 20 rings of its lid.
spincat::PointCloud cylinder() {
  spincat::PointCloud cloud;
  constexpr int kAround = 60;
  for (int ring = 0; ring < 60; ++ring) {
    const double radius = ring < 40 ? 1.0 : (ring - 39.5) / 20.0;
    const double z = ring < 40 ? ring / 20.0 : 2.0;
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      cloud.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return cloud;
}

// The correlation of two images, 1 for equal ones.
double likeness(std::span<const float> a, std::span<const float> b) {
  const auto n = static_cast<double>(a.size());
  double sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i];
    sum_b += b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
    ab += a[i] * b[i];
  }
  return (n * ab - sum_a * sum_b) / std::sqrt((n * aa - sum_a * sum_a) * (n * bb - sum_b * sum_b));
}

}  // namespace

int main() {
  try {
    // Normals, a common scale, and 100 of the points, chosen at random by the seed.
    spincat::PrepareSettings settings;
    settings.spin_points = 100;
    settings.surface = spincat::SurfaceKind::samples;  // all points count, whether they can be seen from outside or not
    const spincat::PreparedObject object = spincat::prepare(cylinder(), settings, 1);

    spincat::SpinImageParams params;
    params.image_width = 16;
    params.bin_size = 0.1;
    params.validate();
    const spincat::SpinImages images = spincat::make_spin_images(object.surface, object.spin_points, params, 2);
    std::printf("%zu spin images of %zu x %zu\n", images.count(), images.shape().rows, images.shape().columns);

    // The first point whose normal points sideways, and how like its image the others are.
    const auto is_side = [&](std::size_t k) { return std::abs(object.spin_points.nz()[k]) < 0.1F; };
    std::size_t first = 0;
    while (!is_side(first)) {
      ++first;
    }
    double side = 0.0, lid = 0.0;
    int sides = 0, lids = 0;
    for (std::size_t k = 0; k < images.count(); ++k) {
      const double like = likeness(images.image(first), images.image(k));
      (is_side(k) ? side : lid) += like;
      ++(is_side(k) ? sides : lids);
    }
    std::printf("likeness to a point of the side: %.2f for the side, %.2f for the lid\n", side / sides, lid / lids);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "spin_images: %s\n", error.what());
    return 1;
  }
}
