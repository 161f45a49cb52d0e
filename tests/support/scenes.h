// Rendered scenes of things on a table, with what belongs to what.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "spincat/camera/render/render.h"
#include "spincat/camera/render/viewpoint.h"
#include "spincat/camera/segment/table.h"
#include "support/shapes.h"

namespace spincat::test {

inline Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) {
    v += by;
  }
  return mesh;
}

// Two triangles in the plane z = 0, `half` metres to each side of the origin.
inline Mesh table_top(double half) {
  return {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

// What a camera sees of a table at z = 0 and of things on it, in a world in metres.
struct Scene {
  Viewpoint viewpoint = Viewpoint::looking_at({0.0, -0.8, 0.7}, {0.0, 0.0, 0.0});
  Intrinsics intrinsics;
  double table_half = 0.6;
  std::vector<Mesh> things;
  int width = 640;
  int height = 480;

  DepthImage picture() const {
    DepthImage image(width, height);
    if (table_half > 0.0) {
      draw_depth(viewpoint.to_camera(table_top(table_half)), intrinsics, image);
    }
    for (const Mesh& thing : things) {
      draw_depth(viewpoint.to_camera(thing), intrinsics, image);
    }
    return image;
  }

  // The number of the thing that each pixel shows, from 1; 0 for none.
  std::vector<std::size_t> truth() const {
    const DepthImage all = picture();
    std::vector<std::size_t> labels(all.depth.size(), 0);
    for (std::size_t k = 0; k < things.size(); ++k) {
      DepthImage alone(width, height);
      draw_depth(viewpoint.to_camera(things[k]), intrinsics, alone);
      for (std::size_t i = 0; i < labels.size(); ++i) {
        if (alone.depth[i] > 0.0F && alone.depth[i] == all.depth[i]) {
          labels[i] = k + 1;
        }
      }
    }
    return labels;
  }

  // The plane z = 0 in the camera's frame.
  SupportPlane table() const {
    const Eigen::Vector3f normal = (viewpoint.axes * Vec3::UnitZ()).cast<float>();
    return {normal, static_cast<float>(viewpoint.eye.z())};
  }
};

}  // namespace spincat::test
