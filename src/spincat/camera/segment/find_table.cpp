#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "spincat/camera/segment/table.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

using Eigen::Vector3f;

constexpr int kStride = 4;                    // every fourth pixel both ways is looked at
constexpr std::size_t kScored = 2'500;        // of these, to score a triple
constexpr std::size_t kFewestReadings = 300;  // of these
constexpr float kLeastCosine = 0.94F;         // of the angle between the plane's normal and up: 20 degrees
constexpr double kKeep = 1.2;                 // how much better another plane must be than that of the frame before

struct Reading {
  Vector3f point;
  float weight;
};

std::vector<Reading> readings_of(const DepthImage& image, const Intrinsics& intrinsics) {
  std::vector<Reading> readings;
  for (int v = 0; v < image.height; v += kStride) {
    for (int u = 0; u < image.width; u += kStride) {
      if (const float z = image.at(u, v); z > 0.0F) {
        readings.push_back({intrinsics.point(u, v, z), 1.0F / (z * z)});
      }
    }
  }
  return readings;
}

bool lies_on(const SupportPlane& table, const Reading& reading) {
  return std::abs(table.height(reading.point)) < plane_tolerance(reading.point.z());
}

// The share of the weight of every `step`-th reading that lies on the plane.
double share_on(const SupportPlane& table, const std::vector<Reading>& readings, std::size_t step) {
  double on = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < readings.size(); i += step) {
    all += readings[i].weight;
    on += lies_on(table, readings[i]) ? readings[i].weight : 0.0F;
  }
  return on / all;
}

SupportPlane towards_camera(Vector3f normal, const Vector3f& point) {
  normal.normalize();
  const float offset = -normal.dot(point);
  return offset < 0.0F ? SupportPlane{-normal, -offset} : SupportPlane{normal, offset};
}

bool may_be_table(const SupportPlane& table, const TableSettings& settings) {
  return table.normal.allFinite() && (!settings.up || table.normal.dot(settings.up->normalized()) > kLeastCosine);
}

std::optional<SupportPlane> plane_of(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const Vector3f normal = (b - a).cross(c - a);
  if (!(normal.norm() > 1e-6F)) {
    return {};
  }
  return towards_camera(normal, a);
}

// The plane of least squares through the readings on `table`.
SupportPlane refitted(const SupportPlane& table, const std::vector<Reading>& readings) {
  double weight = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Reading& reading : readings) {
    if (lies_on(table, reading)) {
      const Eigen::Vector3d p = reading.point.cast<double>();
      weight += reading.weight;
      sum += reading.weight * p;
      products += reading.weight * p * p.transpose();
    }
  }
  const Eigen::Vector3d mean = sum / weight;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(products / weight - mean * mean.transpose());
  return towards_camera(solver.eigenvectors().col(0).cast<float>(), mean.cast<float>());
}

}  // namespace

std::optional<SupportPlane> find_table(const DepthImage& image, const Intrinsics& intrinsics,
                                       const TableSettings& settings, const std::optional<SupportPlane>& before) {
  const std::vector<Reading> readings = readings_of(image, intrinsics);
  if (readings.size() < kFewestReadings) {
    return {};
  }
  const std::size_t step = std::max<std::size_t>(readings.size() / kScored, 1);
  SupportPlane best;
  const auto consider = [&](const SupportPlane& table, double favour) {
    const double share = favour * share_on(table, readings, step);
    if (share > best.share) {
      best = table;
      best.share = share;
    }
  };
  if (before && may_be_table(*before, settings)) {
    consider(*before, kKeep);
  }
  Random random(settings.seed);
  const auto any = [&]() -> const Vector3f& { return readings[random.below(readings.size())].point; };
  for (int trial = 0; trial < settings.trials; ++trial) {
    const std::optional<SupportPlane> table = plane_of(any(), any(), any());
    if (table && may_be_table(*table, settings)) {
      consider(*table, 1.0);
    }
  }
  constexpr int kRefits = 3;
  for (int k = 0; k < kRefits && best.share > 0.0; ++k) {
    best = refitted(best, readings);
    best.share = share_on(best, readings, 1);
  }
  if (best.share < settings.least_share || !may_be_table(best, settings)) {
    return {};
  }
  return best;
}

}  // namespace spincat
