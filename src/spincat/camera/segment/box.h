// The box around what is seen of an object.
#pragma once

#include <Eigen/Core>
#include <span>

#include "spincat/camera/segment/scene.h"

namespace spincat {

// The upright box of least footprint around the points, from their lowest over the plane to their highest; where that
// is less than `foot` over the plane, from the plane. Points that are almost alone in their square of `cell` metres, as
// those between an object's edge and what lies behind, do not count. Deterministic. Preconditions: there is a point;
// cell > 0.
OrientedBox box_on_plane(std::span<const Eigen::Vector3f> points, const SupportPlane& plane, float cell, float foot);

}  // namespace spincat
