// What can be said of an object before anything is done with it: its size and its defects.
#pragma once

#include <cstddef>

#include "spincat/geometry/object.h"

namespace spincat {

struct ObjectFacts {
  bool is_mesh = false;
  std::size_t points = 0;  // vertices of a mesh, points of a cloud
  std::size_t triangles = 0;
  std::size_t unfinite_points = 0;     // of the file, left out by its reader
  std::size_t repeated_points = 0;     // at the position of an earlier one
  std::size_t unused_vertices = 0;     // that no triangle uses
  std::size_t flat_triangles = 0;      // without area
  std::size_t repeated_triangles = 0;  // with the corners of an earlier one, either way round; flat ones not counted
  std::size_t flipped_triangles = 0;   // that look the other way than those they hang together with; see defects.h
  std::size_t dust_triangles = 0;      // far from the object and no part of it; see dust.h
  std::size_t lone_points = 0;         // of a cloud, no part of the object; see lone_points.h
  bool has_normals = false;            // a cloud that brings its own
  Vec3 low = Vec3::Zero();             // bounding box of the triangles or points, in the file's unit
  Vec3 high = Vec3::Zero();
  double area = 0.0;        // of all triangles, repeated ones as often as they are there
  double resolution = 0.0;  // mesh resolution, in the file's unit; see resolution.h
};

// Precondition: the object has a point.
ObjectFacts facts_of(const Object& object);

}  // namespace spincat
