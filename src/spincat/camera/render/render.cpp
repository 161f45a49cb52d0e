#include "spincat/camera/render/render.h"

#include <array>
#include <cstddef>

#include "spincat/geometry/rasterise.h"

namespace spincat {
namespace {

constexpr double kNearest = 0.01;  // metres

// The part of a triangle in front of the plane z = kNearest: a polygon of up to four corners.
struct Polygon {
  std::array<Vec3, 4> corners;
  std::size_t count = 0;
};

Polygon in_front(const std::array<Vec3, 3>& triangle) {
  Polygon result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& from = triangle[k];
    const Vec3& to = triangle[(k + 1) % 3];
    if (from.z() >= kNearest) {
      result.corners[result.count++] = from;
    }
    if ((from.z() >= kNearest) != (to.z() >= kNearest)) {
      result.corners[result.count++] = from + (kNearest - from.z()) / (to.z() - from.z()) * (to - from);
    }
  }
  return result;
}

Vec3 project(const Vec3& p, const Intrinsics& intrinsics) {
  // Pixel (u, v) is where (u, v) is by the intrinsics; draw_triangle puts its centre at (u + .5, v + .5).
  return {intrinsics.fx * p.x() / p.z() + intrinsics.cx + 0.5, intrinsics.fy * p.y() / p.z() + intrinsics.cy + 0.5,
          1.0 / p.z()};
}

}  // namespace

void draw_depth(const Mesh& mesh, const Intrinsics& intrinsics, DepthImage& image) {
  const auto keep = [&](std::size_t pixel, double inverse_depth) {
    const auto z = static_cast<float>(1.0 / inverse_depth);
    if (!(image.depth[pixel] > 0.0F) || z < image.depth[pixel]) {
      image.depth[pixel] = z;
    }
  };
  for (const Triangle& t : mesh.triangles) {
    const Polygon polygon = in_front({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    for (std::size_t k = 2; k < polygon.count; ++k) {
      draw_triangle(image.width, image.height, project(polygon.corners[0], intrinsics),
                    project(polygon.corners[k - 1], intrinsics), project(polygon.corners[k], intrinsics), keep);
    }
  }
}

}  // namespace spincat
