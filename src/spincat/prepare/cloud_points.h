// From a cloud to the points and normals that stand for its surface.
#pragma once

#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/prepare.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {

// At most settings.points points of a normalised cloud, evenly spread; with SurfaceKind::vertices all of them. Normals
// that the cloud has stay as they are; others are estimated from neighbours and turned to the sensor, or, where there
// is none, to the side from which the points can be seen (SurfaceKind::external) or away from the centroid
// (NormalOrientation::outward). SurfaceKind::external, of a cloud with neither normals nor a sensor, leaves out points
// that cannot be seen from outside, and puts points between those of a thin cloud, where 64 or more can be seen.
// Deterministic for one state of `random`.
SurfacePoints cloud_points(PointCloud cloud, const PrepareSettings& settings, Random& random);

// Normals of so many points, evenly spread, estimated anew from their neighbours, each on the side that the given one
// showed: for a surface whose own normals are rough. Deterministic for one state of `random`.
SurfacePoints with_normals_of_neighbours(const SurfacePoints& points, const PrepareSettings& settings, Random& random);

}  // namespace spincat
