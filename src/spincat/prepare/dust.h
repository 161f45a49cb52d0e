// Pieces of a mesh that are no part of the object: what an exporter left behind far from it.
#pragma once

#include <cstdint>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// Indices of the triangles that are dust, ascending: pieces (triangles that hang together at shared positions) that lie
// wholly beyond twice the object's reach and have no more than a hundredth of the area between them. The reach is the
// distance from the centroid within which 99 % of the area lie. Deterministic. Precondition: indices in range;
// coordinates of moderate size (normalised).
std::vector<std::uint32_t> dust_of(const Mesh& mesh);

// The mesh without some of its triangles (indices ascending). Its vertices stay.
Mesh without_triangles(const Mesh& mesh, const std::vector<std::uint32_t>& triangles);

}  // namespace spincat
