#include "spincat/prepare/external_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "spincat/geometry/rasterise.h"
#include "spincat/prepare/normals.h"

namespace spincat {
namespace {

constexpr int kPixels = 64;            // rows and columns of the z-buffer
constexpr double kEyeDistance = 3.0;   // from the origin
constexpr double kFieldOfView = 42.0;  // degrees; the unit sphere spans 38.9 degrees from there
constexpr double kCellEdge = 0.04;     // of even_out's cells
constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();

// A rotation drawn uniformly from all rotations (Shoemake's unit quaternion from three uniform numbers).
Eigen::Matrix3d random_rotation(Random& random) {
  const double u = random.uniform();
  const double v = 2.0 * std::numbers::pi * random.uniform();
  const double w = 2.0 * std::numbers::pi * random.uniform();
  const double a = std::sqrt(1.0 - u);
  const double b = std::sqrt(u);
  return Eigen::Quaterniond(a * std::sin(v), a * std::cos(v), b * std::sin(w), b * std::cos(w)).toRotationMatrix();
}

std::array<Vec3, 20> dodecahedron_corners() {
  constexpr double kPhi = std::numbers::phi;
  std::array<Vec3, 20> corners;
  std::size_t n = 0;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) {
        corners[n++] = Vec3(a, b, c);
      }
      corners[n++] = Vec3(0.0, a / kPhi, b * kPhi);
      corners[n++] = Vec3(a / kPhi, b * kPhi, 0.0);
      corners[n++] = Vec3(b * kPhi, 0.0, a / kPhi);
    }
  }
  for (Vec3& corner : corners) {
    corner.normalize();
  }
  return corners;
}

// A camera at `eye` that looks at the origin. Its frame: x right, y down the image, z forward.
class Camera {
 public:
  explicit Camera(const Vec3& eye) : eye_(eye) {
    const Vec3 forward = -eye.normalized();
    const Vec3 helper = std::abs(forward.z()) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const Vec3 right = forward.cross(helper).normalized();
    axes_.row(0) = right;
    axes_.row(1) = forward.cross(right);
    axes_.row(2) = forward;
  }

  // Pixel coordinates (pixel (c, r) has its centre at (c + .5, r + .5)), and one over the depth, which is linear over
  // the image of a plane.
  Vec3 project(const Vec3& p) const {
    const Vec3 q = axes_ * (p - eye_);
    const double inverse_depth = 1.0 / q.z();
    return {0.5 * kPixels + kFocal * q.x() * inverse_depth, 0.5 * kPixels + kFocal * q.y() * inverse_depth,
            inverse_depth};
  }

  Vec3 unproject(int column, int row, double inverse_depth) const {
    const double depth = 1.0 / inverse_depth;
    const Vec3 q((column + 0.5 - 0.5 * kPixels) / kFocal * depth, (row + 0.5 - 0.5 * kPixels) / kFocal * depth, depth);
    return eye_ + axes_.transpose() * q;
  }

  const Vec3& eye() const { return eye_; }

 private:
  static inline const double kFocal = 0.5 * kPixels / std::tan(0.5 * kFieldOfView * std::numbers::pi / 180.0);
  Vec3 eye_;
  Eigen::Matrix3d axes_;
};

// What a camera sees: at each pixel the nearest face and one over its depth.
class DepthBuffer {
 public:
  DepthBuffer() { clear(); }

  void clear() {
    inverse_depth_.fill(0.0);
    face_.fill(kNoFace);
  }

  void draw(std::uint32_t face, const Vec3& a, const Vec3& b, const Vec3& c) {
    draw_triangle(kPixels, kPixels, a, b, c, [&](std::size_t pixel, double inverse_depth) {
      if (inverse_depth > inverse_depth_[pixel]) {
        inverse_depth_[pixel] = inverse_depth;
        face_[pixel] = face;
      }
    });
  }

  std::uint32_t face(int pixel) const { return face_[pixel]; }
  double inverse_depth(int pixel) const { return inverse_depth_[pixel]; }

 private:
  std::array<double, kPixels * kPixels> inverse_depth_;
  std::array<std::uint32_t, kPixels * kPixels> face_;
};

void collect_visible(const DepthBuffer& buffer, const Camera& camera, const std::vector<Vec3>& unit_normals,
                     SurfacePoints& points) {
  for (int row = 0; row < kPixels; ++row) {
    for (int column = 0; column < kPixels; ++column) {
      const int pixel = row * kPixels + column;
      const std::uint32_t face = buffer.face(pixel);
      if (face == kNoFace) {
        continue;
      }
      const Vec3 p = camera.unproject(column, row, buffer.inverse_depth(pixel));
      const Vec3& n = unit_normals[face];
      points.positions.push_back(p);
      points.normals.push_back((camera.eye() - p).dot(n) < 0.0 ? Vec3(-n) : n);
    }
  }
}

// One number for the cell of `p` and the octant of `n`: 20 bits an axis are plenty for coordinates within a few units.
std::uint64_t cell_key(const Vec3& p, const Vec3& n) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = p[axis] / kCellEdge;
    const auto towards_zero = static_cast<std::int64_t>(at);
    const std::int64_t cell = towards_zero - (at < static_cast<double>(towards_zero) ? 1 : 0) + (1 << 19);
    key = (key << 20) | (static_cast<std::uint64_t>(cell) & 0xFFFFFU);
    key = (key << 1) | (n[axis] < 0.0 ? 1U : 0U);
  }
  return key;
}

// For each key how many of the keys are equal to it. A table with open addressing: several times faster than a
// std::unordered_map, which was most of the time of even_out.
std::vector<std::uint32_t> count_equal(const std::vector<std::uint64_t>& keys) {
  const std::size_t size = std::bit_ceil(2 * keys.size() + 1);
  const int shift = std::countl_zero(size - 1);
  std::vector<std::uint32_t> first(size, 0);  // the first key at a place and one more; 0: free
  std::vector<std::uint32_t> counts(keys.size(), 0);
  std::vector<std::uint32_t> of(keys.size());  // the first key that each is equal to
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    // Fibonacci hashing: the upper bits of a product with 2^64 over the golden section.
    std::size_t at = (keys[i] * 0x9E3779B97F4A7C15ULL) >> shift;
    while (first[at] != 0 && keys[first[at] - 1] != keys[i]) {
      at = (at + 1) & (size - 1);
    }
    if (first[at] == 0) {
      first[at] = i + 1;
    }
    of[i] = first[at] - 1;
    ++counts[of[i]];
  }
  std::ranges::transform(of, of.begin(), [&](std::uint32_t i) { return counts[i]; });
  return of;
}

struct Waiting {
  double time;
  std::uint32_t point;
  auto operator<=>(const Waiting&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer
};

// The `count` points that come first, in order, when point i waits for -log(1 - u_i) crowd_i with u_i uniform. Only
// those that can be among them need a logarithm: u <= -log(1 - u) <= u / (1 - u).
std::vector<Waiting> first_to_come(std::span<const std::uint32_t> crowd, std::size_t count, Random& random) {
  std::vector<double> drawn(crowd.size());
  std::vector<double> latest(crowd.size());
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    drawn[i] = random.uniform();
    latest[i] = drawn[i] * crowd[i] / (1.0 - drawn[i]);
  }
  double limit = std::numeric_limits<double>::infinity();
  if (count < crowd.size()) {
    constexpr double kRounding = 1.0 + 1e-9;
    const auto last = latest.begin() + static_cast<std::ptrdiff_t>(count);
    std::ranges::nth_element(latest, last);
    limit = *last * kRounding;
  }
  std::vector<Waiting> order;
  for (std::uint32_t i = 0; i < crowd.size(); ++i) {
    if (drawn[i] * crowd[i] <= limit) {
      order.push_back({-std::log(1.0 - drawn[i]) * crowd[i], i});
    }
  }
  std::ranges::sort(order);
  order.resize(count);
  return order;
}

}  // namespace

SurfacePoints external_surface(const Mesh& mesh, Random& random) {
  std::vector<Vec3> unit_normals = face_area_normals(mesh);
  for (Vec3& n : unit_normals) {
    n.normalize();
  }
  const Eigen::Matrix3d turn = random_rotation(random);
  std::vector<Vec3> projected(mesh.vertices.size());
  DepthBuffer buffer;
  SurfacePoints points;
  constexpr std::size_t kUsualPoints = 1 << 15;
  points.positions.reserve(kUsualPoints);
  points.normals.reserve(kUsualPoints);
  for (const Vec3& corner : dodecahedron_corners()) {
    const Camera camera(kEyeDistance * (turn * corner));
    std::ranges::transform(mesh.vertices, projected.begin(), [&](const Vec3& v) { return camera.project(v); });
    buffer.clear();
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
      const Triangle& t = mesh.triangles[f];
      if (unit_normals[f].isZero()) {
        continue;  // rounding could still give it a sliver of area in the image, and it has no normal to hand on
      }
      buffer.draw(f, projected[t[0]], projected[t[1]], projected[t[2]]);
    }
    collect_visible(buffer, camera, unit_normals, points);
  }
  return points;
}

SurfacePoints even_out(const SurfacePoints& points, std::size_t count, Random& random) {
  const std::size_t size = points.positions.size();
  std::vector<std::uint64_t> keys(size);
  std::ranges::transform(points.positions, points.normals, keys.begin(), cell_key);
  const std::vector<std::uint32_t> crowd = count_equal(keys);
  // Weighted sampling without replacement (Efraimidis and Spirakis): the smallest of exponential waiting times whose
  // rate is the point's weight, here one over the number of points in its cell.
  const std::vector<Waiting> order = first_to_come(crowd, std::min(count, size), random);
  SurfacePoints drawn;
  for (const Waiting& waiting : order) {
    drawn.positions.push_back(points.positions[waiting.point]);
    drawn.normals.push_back(points.normals[waiting.point]);
  }
  return drawn;
}

}  // namespace spincat
