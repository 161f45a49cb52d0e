// Which triangles of a mesh are broken.
#pragma once

#include <cstdint>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// Indices into Mesh::triangles, ascending. No triangle is in two lists.
struct MeshDefects {
  std::vector<std::uint32_t> flat;      // without area
  std::vector<std::uint32_t> repeated;  // with the corners of an earlier one, either way round
  std::vector<std::uint32_t> flipped;   // that look the other way than most of those they hang together with
};

// Vertices at one position are one vertex. Two triangles hang together at an edge that they alone share (flat and
// repeated ones set aside), and look the same way when they run along it in opposite directions. Of each set of
// triangles that hang together, the smaller part by number is flipped (of two halves the one that does not hold the
// first triangle); the set says nothing of which side is outside. On a surface with one side only, such as Moebius's,
// what is flipped depends on the order of the triangles. Deterministic.
MeshDefects defects_of(const Mesh& mesh);

}  // namespace spincat
