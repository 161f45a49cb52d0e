#include "spincat/camera/source/cloud_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "spincat/error.h"

namespace spincat {
namespace {

// The line of least squares through places (at, value): value = slope at + offset. `for_each_place` calls what it is
// given with each place; twice, so that no place need be kept.
struct Line {
  double slope;
  double offset;
  double fit;  // the share of the values' spread that it explains
};

template <class ForEachPlace>
Line fitted_line(std::size_t places, const ForEachPlace& for_each_place) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  const auto n = static_cast<double>(places);
  for_each_place([&](double at, double value) {
    x += at / n;
    y += value / n;
  });
  for_each_place([&](double at, double value) {
    xx += (at - x) * (at - x);
    xy += (at - x) * (value - y);
    yy += (value - y) * (value - y);
  });
  const double slope = xy / xx;
  return {slope, y - slope * x, slope * xy / yy};
}

constexpr const char* kExpected = "expected x right, y down, z forward, or y up and z backward";

// 1 where z points forward, -1 where it points back at the camera.
double forward_of(const OrganizedCloud& cloud) {
  std::size_t before = 0;
  std::size_t behind = 0;
  for (const Vec3& p : cloud.points) {
    before += p.allFinite() && p.z() > 0.0 ? 1 : 0;
    behind += p.allFinite() && p.z() < 0.0 ? 1 : 0;
  }
  constexpr std::size_t kFewOf = 10;  // a tenth may be errors of the sensor
  if (std::min(before, behind) > std::max(before, behind) / kFewOf) {
    throw InputError(
        fmt::format("z is negative for {} of its points and positive for {}: {}", behind, before, kExpected));
  }
  return before >= behind ? 1.0 : -1.0;
}

// Calls `see` with each point that was measured, its depth, its column and its row.
template <class See>
void for_each_measured(const OrganizedCloud& cloud, double forward, const See& see) {
  std::size_t i = 0;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Vec3& p = cloud.points[i++];
      if (const double depth = forward * p.z(); p.allFinite() && depth > 0.0) {
        see(p, depth, u, v);
      }
    }
  }
}

// A focal length. Where an axis points the other way the line falls, and the picture is the same.
double focal_length(const Line& line, char axis) {
  constexpr double kLeastFit = 0.9;
  if (!(line.fit >= kLeastFit)) {
    throw InputError(
        fmt::format("is not what a camera sees along z ({} / z does not follow the pixels): {}", axis, kExpected));
  }
  return std::abs(line.slope);
}

}  // namespace

// u = fx x / z + cx.
Frame frame_of_cloud(const OrganizedCloud& cloud) {
  const double forward = forward_of(cloud);
  Frame frame;
  frame.image = DepthImage(cloud.width, cloud.height);
  std::size_t measured = 0;
  for_each_measured(cloud, forward, [&](const Vec3&, double depth, int u, int v) {
    frame.image.depth[frame.image.index(u, v)] = static_cast<float>(depth);
    ++measured;
  });
  constexpr std::size_t kFewest = 10;
  if (measured >= kFewest) {
    const Line x = fitted_line(measured, [&](const auto& see) {
      for_each_measured(cloud, forward, [&](const Vec3& p, double depth, int u, int) { see(p.x() / depth, u); });
    });
    const Line y = fitted_line(measured, [&](const auto& see) {
      for_each_measured(cloud, forward, [&](const Vec3& p, double depth, int, int v) { see(p.y() / depth, v); });
    });
    frame.intrinsics = {focal_length(x, 'x'), focal_length(y, 'y'), x.offset, y.offset};
    frame.intrinsics.validate();
  }
  return frame;
}

}  // namespace spincat
