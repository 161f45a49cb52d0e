// Bringing an object to a common size and place.
#pragma once

#include <span>

#include "spincat/geometry/object.h"

namespace spincat {

// x -> (x - centre) * factor.
struct Similarity {
  Vec3 centre = Vec3::Zero();
  double factor = 1.0;
  Vec3 operator()(const Vec3& x) const { return (x - centre) * factor; }
};

// The similarity that puts the centre of the points' bounding box at the origin and the furthest point at distance 1.
// Coordinates of any finite size are fine (1e30, 1e-30).
// Throws InputError when there is no point, or when all points are the same.
Similarity unit_similarity(std::span<const Vec3> points);

// The mesh with only those vertices that triangles use, in their order: the others are no part of the object and must
// not decide about its size. They are added to those left out.
Mesh without_unused_vertices(const Mesh& mesh);

// Moves and scales all vertices or points; normals keep their direction and the sensor moves along.
Mesh transformed(const Mesh& mesh, const Similarity& similarity);
PointCloud transformed(const PointCloud& cloud, const Similarity& similarity);

// Multiplies every coordinate by the factor of its axis (all > 0). Normals are stretched so that they stay
// perpendicular to the surface; the sensor is stretched along.
Mesh stretched(const Mesh& mesh, const Vec3& factors);
PointCloud stretched(const PointCloud& cloud, const Vec3& factors);

}  // namespace spincat
