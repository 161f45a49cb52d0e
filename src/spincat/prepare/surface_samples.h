// Points drawn evenly from the surface of a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"

namespace spincat {

// Points with unit normals, before they are brought into the layout of OrientedPoints.
struct SurfacePoints {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
};

// `count` independent points, uniform over the area of the mesh, each with the normal of its face. A modeller's
// vertices say where detail was drawn, not where the surface is; these points describe the surface.
// Deterministic for one state of `random`. Precondition: the mesh has area (has_area).
SurfacePoints surface_samples(const Mesh& mesh, std::size_t count, Random& random);

// Whether any triangle has an area above zero.
bool has_area(const Mesh& mesh);

}  // namespace spincat
