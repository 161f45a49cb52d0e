// From an object as a file holds it to the points that spin images are made of and from.
#pragma once

#include <cstdint>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/geometry/oriented_points.h"
#include "spincat/range.h"

#pragma GCC visibility push(default)
namespace spincat {

// Which points stand for the surface of a mesh. (A cloud's points are its surface, but for `external`.)
enum class SurfaceKind {
  vertices,  // the vertices with their vertex normals: the paper's way
  samples,   // points drawn evenly from all faces
  external,  // points drawn evenly from what can be seen from outside
};

// How the sign of a normal is chosen where nothing else tells it.
enum class NormalOrientation {
  as_given,  // as the faces' winding or the file gives it
  outward,   // away from the centroid (and always towards the sensor, where a cloud has one)
};

struct PrepareSettings {
  SurfaceKind surface = SurfaceKind::external;
  NormalOrientation orientation = NormalOrientation::outward;
  int points = 2048;      // surface points; SurfaceKind::vertices takes all vertices instead
  int spin_points = 256;  // M
  int neighbours = 24;    // of a cloud's point, for its normal

  static constexpr Range kPoints{1, 10'000'000};
  static constexpr Range kSpinPoints{1, 10'000'000};
  static constexpr Range kNeighbours{3, 1'000};

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

struct PreparedObject {
  OrientedPoints surface;      // normalised: centre of the bounding box at 0, furthest point at distance 1
  OrientedPoints spin_points;  // some of the surface's points, in random order
  // Which of the file's points the surface points are, ascending, and which the spin points. Both are empty where
  // points are drawn: with all kinds of surface but SurfaceKind::vertices.
  std::vector<std::uint32_t> surface_rows;
  std::vector<std::uint32_t> spin_rows;
  double scale = 1.0;          // prepared units in one unit of the file
  Vec3 centre = Vec3::Zero();  // where the prepared origin is in the file: x_file = x / scale + centre
};

// Prepares a mesh or a cloud. Meshes without any area are treated as the cloud of their vertices. Repeated points of a
// cloud count once, points that stand alone (lone_points.h) and dust far from a mesh (dust.h) not at all. Faces of a
// rough mesh (roughness.h) tell where the surface is, and their neighbours what its normals are. Where an object has
// fewer points than spin points are asked for, SurfaceKind::vertices repeats them, so that an observation keeps its
// length (the paper's concatenation needs that), SurfaceKind::external puts points between those of a cloud
// (cloud_points.h), and SurfaceKind::samples uses what is there. Deterministic: the same object, settings and seed give
// the same points, on any number of threads. Throws InputError (without a file name) when the object has no extent: no
// points, or all at one place.
PreparedObject prepare(const Object& object, const PrepareSettings& settings, std::uint64_t seed);

// The training copy number `copy` of an object: each axis stretched by exp(U(-amount, amount)). Deterministic.
Object stretched_copy(const Object& object, int copy, double amount, std::uint64_t seed);

}  // namespace spincat
#pragma GCC visibility pop
