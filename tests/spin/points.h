// Small sets of oriented points for the tests of spin images.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <span>
#include <vector>

#include "spincat/geometry/oriented_points.h"
#include "spincat/geometry/random.h"
#include "spincat/spin/params.h"

namespace spincat::test {

struct OrientedPoint {
  Eigen::Vector3f position;
  Eigen::Vector3f normal{0.0F, 0.0F, 1.0F};
};

inline OrientedPoints points_of(std::span<const OrientedPoint> list) {
  OrientedPoints points(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    points.set(i, list[i].position, list[i].normal);
  }
  return points;
}

inline OrientedPoints points_of(std::initializer_list<OrientedPoint> list) {
  return points_of(std::span(list.begin(), list.size()));
}

inline Eigen::Vector3f random_unit(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized().cast<float>();
}

// Points all through the cube [-1, 1]^3 with normals in every direction.
inline OrientedPoints random_points(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  OrientedPoints points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    points.set(i, p.cast<float>(), random_unit(random));
  }
  return points;
}

// Points on a bumpy sphere of radius about 1, normals roughly outwards: neighbours in space have like normals, as on a
// real object.
inline OrientedPoints bumpy_sphere(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  OrientedPoints points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f n = random_unit(random);
    const float r = 1.0F + 0.1F * std::sin(5.0F * n.x()) * std::cos(4.0F * n.y());
    points.set(i, r * n, (n + 0.1F * random_unit(random)).normalized());
  }
  return points;
}

inline OrientedPoints turned(const OrientedPoints& points, const Eigen::Matrix3f& rotation) {
  OrientedPoints result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.set(i, rotation * points.position(i), rotation * points.normal(i));
  }
  return result;
}

inline double sum(std::span<const float> values) {
  double total = 0.0;
  for (const float v : values) {
    total += v;
  }
  return total;
}

// W = 4 and b = 1, every place a small binary fraction: the expected numbers are exact.
inline SpinImageParams johnson4(double support_angle = 180.0) {
  SpinImageParams params;
  params.image_width = 4;
  params.bin_size = 1.0;
  params.support_angle = support_angle;
  return params;
}

inline SpinImageParams pcl4(double support_angle = 90.0) {
  SpinImageParams params = johnson4(support_angle);
  params.convention = SpinConvention::pcl;
  return params;
}

}  // namespace spincat::test
