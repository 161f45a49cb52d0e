// What a scanner would make of an object: points without faces and normals, not quite in their place.
#pragma once

#include <cstddef>
#include <cstdint>

#include "spincat/geometry/object.h"

namespace spincat {

// `points` points drawn evenly from a mesh's surface (the used vertices of a mesh without area), or the points of a
// cloud (each once, without those that stand alone), each moved along each axis by a normal deviate with the standard
// deviation `noise`, in diameters of the object: twice the distance of the furthest point from the centre of the
// bounding box. Normals are left out, the sensor is kept. Deterministic. Throws InputError when the object has no
// point. Preconditions: points > 0, noise >= 0.
PointCloud as_cloud(const Object& object, std::size_t points, double noise, std::uint64_t seed);

}  // namespace spincat
