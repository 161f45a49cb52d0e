#include "spincat/prepare/external_surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "spincat/geometry/rasterise.h"
#include "spincat/prepare/cameras.h"
#include "spincat/prepare/normals.h"

namespace spincat {
namespace {

constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();

// What a camera sees: at each pixel the nearest face and one over its depth.
class DepthBuffer {
 public:
  DepthBuffer() { clear(); }

  void clear() {
    inverse_depth_.fill(0.0);
    face_.fill(kNoFace);
  }

  void draw(std::uint32_t face, const Vec3& a, const Vec3& b, const Vec3& c) {
    draw_triangle(Camera::kPixels, Camera::kPixels, a, b, c, [&](std::size_t pixel, double inverse_depth) {
      if (inverse_depth > inverse_depth_[pixel]) {
        inverse_depth_[pixel] = inverse_depth;
        face_[pixel] = face;
      }
    });
  }

  std::uint32_t face(int pixel) const { return face_[pixel]; }
  double inverse_depth(int pixel) const { return inverse_depth_[pixel]; }

 private:
  std::array<double, Camera::kPixels * Camera::kPixels> inverse_depth_;
  std::array<std::uint32_t, Camera::kPixels * Camera::kPixels> face_;
};

void collect_visible(const DepthBuffer& buffer, const Camera& camera, const std::vector<Vec3>& unit_normals,
                     SurfacePoints& points) {
  for (int row = 0; row < Camera::kPixels; ++row) {
    for (int column = 0; column < Camera::kPixels; ++column) {
      const int pixel = row * Camera::kPixels + column;
      const std::uint32_t face = buffer.face(pixel);
      if (face == kNoFace) {
        continue;
      }
      const Vec3 p = camera.unproject(column, row, buffer.inverse_depth(pixel));
      const Vec3& n = unit_normals[face];
      points.positions.push_back(p);
      points.normals.push_back(camera.sees_back(p, n) ? Vec3(-n) : n);
    }
  }
}

}  // namespace

SurfacePoints external_surface(const Mesh& mesh, Random& random) {
  std::vector<Vec3> unit_normals = face_area_normals(mesh);
  for (Vec3& n : unit_normals) {
    n.normalize();
  }
  std::vector<Vec3> projected(mesh.vertices.size());
  DepthBuffer buffer;
  SurfacePoints points;
  constexpr std::size_t kUsualPoints = 1 << 15;
  points.positions.reserve(kUsualPoints);
  points.normals.reserve(kUsualPoints);
  for (const Camera& camera : cameras_around(random)) {
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

}  // namespace spincat
