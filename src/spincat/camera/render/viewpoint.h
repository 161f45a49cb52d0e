// Where a camera stands.
#pragma once

#include <Eigen/Geometry>

#include "spincat/geometry/object.h"

namespace spincat {

// A camera at `eye` that looks at `target` in a world whose z axis points up. Its frame: x right, y down, z forward.
struct Viewpoint {
  Eigen::Matrix3d axes;  // rows: the camera's axes in the world
  Vec3 eye;

  // Precondition: the line from eye to target is not vertical.
  static Viewpoint looking_at(const Vec3& eye, const Vec3& target) {
    const Vec3 forward = (target - eye).normalized();
    const Vec3 right = forward.cross(Vec3::UnitZ()).normalized();
    Viewpoint result;
    result.axes.row(0) = right;
    result.axes.row(1) = forward.cross(right);
    result.axes.row(2) = forward;
    result.eye = eye;
    return result;
  }

  Vec3 to_camera(const Vec3& world) const { return axes * (world - eye); }

  Mesh to_camera(Mesh mesh) const {
    for (Vec3& v : mesh.vertices) {
      v = to_camera(v);
    }
    return mesh;
  }
};

}  // namespace spincat
