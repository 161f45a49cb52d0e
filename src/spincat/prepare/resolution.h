// Mesh resolution: the unit in which Johnson gives bin sizes.
#pragma once

#include <span>

#include "spincat/geometry/object.h"

namespace spincat {

// The median length of the mesh's edges, each edge counted once however many faces share it; edges without length are
// left out. 0 when there is none. For an even count the upper of the two middle ones.
double mesh_resolution(const Mesh& mesh);

// The median distance of the points to their nearest other point. 0 for fewer than two points. Preconditions: no point
// is repeated.
double cloud_resolution(std::span<const Vec3> points);

// The mesh resolution of an object in the unit of its file: of a mesh with area that of the mesh, of a cloud that of
// its points, repeated ones counted once, and of a mesh without area that of its vertices. Coordinates of any finite
// size are fine. Throws InputError (without a file name) when it is 0: the object has no extent.
double object_resolution(const Object& object);

}  // namespace spincat
