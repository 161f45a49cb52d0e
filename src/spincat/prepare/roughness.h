// Whether a mesh is so rough that its faces say little about the surface: a scan's noise, or vertices that were moved.
#pragma once

#include "spincat/geometry/object.h"

namespace spincat {

// The median angle in degrees, from 0 to 90, between the planes of two faces that share an edge; whichever side the
// faces look to. Edges of one or of more than two faces do not count, nor do faces without area; 0 where no edge is
// left. Vertices at one position are one. Of a mesh with very many faces, some edges stand for all. Deterministic.
double median_fold(const Mesh& mesh);

}  // namespace spincat
