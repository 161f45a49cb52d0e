#include "spincat/camera/segment/segment_cloud.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace spincat {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr float kNormalRadius = 0.009F;  // metres
constexpr int kLeastRadius = 2;          // pixels
constexpr int kMostRadius = 12;
constexpr int kSteps = 3;   // of neighbours looked at from the middle to the edge
constexpr int kFewest = 6;  // points that a plane is laid through

float neighbour_tolerance(float z) {
  return 0.02F + 0.01F * z;
}

class Normals {
 public:
  Normals(const DepthImage& image, const Intrinsics& intrinsics, const Segmentation& segmentation,
          const Segment& segment)
      : image_(image), intrinsics_(intrinsics), ids_(segmentation.ids), segment_(segment) {}

  bool has(int u, int v) const { return ids_[image_.index(u, v)] == segment_.id; }

  // The normal at a pixel of the segment, towards the camera.
  std::optional<Vector3f> at(int u, int v) const {
    const float z = image_.at(u, v);
    const Vector3f centre = intrinsics_.point(u, v, z);
    const int radius =
        std::clamp(static_cast<int>(std::lround(kNormalRadius * intrinsics_.fx / z)), kLeastRadius, kMostRadius);
    const int step = (radius + kSteps - 1) / kSteps;
    Vector3f sum = Vector3f::Zero();
    Matrix3f products = Matrix3f::Zero();
    int count = 0;
    for (int y = v - radius / step * step; y <= v + radius; y += step) {
      for (int x = u - radius / step * step; x <= u + radius; x += step) {
        if (x < segment_.left || x > segment_.right || y < segment_.top || y > segment_.bottom || !has(x, y) ||
            std::abs(image_.at(x, y) - z) > neighbour_tolerance(z)) {
          continue;
        }
        const Vector3f d = intrinsics_.point(x, y, image_.at(x, y)) - centre;
        sum += d;
        products += d * d.transpose();
        ++count;
      }
    }
    if (count < kFewest) {
      return {};
    }
    const Vector3f mean = sum / static_cast<float>(count);
    Eigen::SelfAdjointEigenSolver<Matrix3f> solver;
    solver.computeDirect(products / static_cast<float>(count) - mean * mean.transpose());
    const Vector3f normal = solver.eigenvectors().col(0);
    return normal.dot(centre) > 0.0F ? Vector3f(-normal) : normal;
  }

 private:
  const DepthImage& image_;
  const Intrinsics& intrinsics_;
  const std::vector<std::uint16_t>& ids_;
  const Segment& segment_;
};

}  // namespace

PointCloud segment_cloud(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                         const Segmentation& segmentation, const Segment& segment) {
  const Eigen::Vector3d up = table.normal.cast<double>();
  Eigen::Matrix3d to_table;  // rows: the axes of the table's frame, in the camera's
  to_table.row(0) = up.unitOrthogonal();
  to_table.row(1) = up.cross(Vec3(to_table.row(0)));
  to_table.row(2) = up;
  const Vec3 sensor(0.0, 0.0, static_cast<double>(table.offset));
  const Normals normals(image, intrinsics, segmentation, segment);
  PointCloud cloud;
  cloud.sensor = sensor;
  std::size_t seen = 0;
  for (int v = segment.top; v <= segment.bottom; ++v) {
    for (int u = segment.left; u <= segment.right; ++u) {
      if (!normals.has(u, v)) {
        continue;
      }
      // The k-th of n pixels is taken where k most / n passes a whole number.
      const std::size_t most = std::min(kMostCloudPoints, segment.pixels);
      const bool taken = (seen + 1) * most / segment.pixels != seen * most / segment.pixels;
      ++seen;
      if (!taken) {
        continue;
      }
      if (const std::optional<Vector3f> normal = normals.at(u, v)) {
        cloud.points.push_back(to_table * intrinsics.point(u, v, image.at(u, v)).cast<double>() + sensor);
        cloud.normals.push_back(to_table * normal->cast<double>());
      }
    }
  }
  return cloud;
}

}  // namespace spincat
