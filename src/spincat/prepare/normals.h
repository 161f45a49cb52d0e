// Normals: of faces, of vertices, and of points that have only neighbours.
#pragma once

#include <span>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// The normal of each triangle, counter-clockwise corners to the front, with the triangle's AREA as its length; zero for
// a triangle without area. Preconditions: indices in range; coordinates of moderate size (normalised).
std::vector<Vec3> face_area_normals(const Mesh& mesh);

// The unit normal of each vertex: the mean of the faces around it, weighted by area. Vertices at one position share
// their faces, so that repeated vertices (STL, exporters that split at texture seams) change nothing. A vertex without
// faces, or whose faces cancel, gets the normal (0, 0, 1).
std::vector<Vec3> vertex_normals(const Mesh& mesh);

// The unit normal of each point: the direction of least spread among its nearest `neighbours` points, itself included
// (principal component analysis). The sign is arbitrary but repeatable. Where the direction is not defined (fewer than
// three points, all collinear or equal), some unit vector perpendicular to the direction of most spread.
// Deterministic. Precondition: neighbours >= 1.
std::vector<Vec3> estimated_normals(std::span<const Vec3> points, int neighbours);

// Turns every normal to the side of `sensor`: (sensor - p) . n >= 0.
void orient_towards(std::span<const Vec3> points, const Vec3& sensor, std::span<Vec3> normals);

// Turns every normal away from the points' centroid c: (p - c) . n >= 0. Right for convex objects and a repeatable
// guess for all others.
void orient_outwards(std::span<const Vec3> points, std::span<Vec3> normals);

}  // namespace spincat
