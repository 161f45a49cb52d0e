// What a depth camera would see of a mesh.
#pragma once

#include "spincat/camera/source/frame_source.h"
#include "spincat/geometry/object.h"

namespace spincat {

// Adds a mesh, given in metres in the camera's frame, to a picture: each pixel keeps the nearer of what it shows and of
// the mesh's faces, both sides of which are seen. What is nearer than 1 cm to the camera's plane is cut off.
// Deterministic.
void draw_depth(const Mesh& mesh, const Intrinsics& intrinsics, DepthImage& image);

}  // namespace spincat
