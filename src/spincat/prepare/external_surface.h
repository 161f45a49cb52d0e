// The surface that can be seen from outside: what an object looks like, whatever its mesh is like inside.
#pragma once

#include <cstddef>

#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {

// Looks at the mesh from the 20 corners of a dodecahedron of radius 3 that `random` turns at random, through a z-buffer
// of 64 x 64 pixels with a field of view of 42 degrees, both sides of every triangle drawn. Each pixel that is covered
// gives one point, with its face's normal turned to the camera: flipped faces, inner walls and repeated faces stop
// mattering. The density is uneven; even_out mends that. Where two faces are equally near, the first one counts.
// Precondition: the mesh is normalised (within distance 1 of the origin). Deterministic for one state of `random`.
SurfacePoints external_surface(const Mesh& mesh, Random& random);

}  // namespace spincat
