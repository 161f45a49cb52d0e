// A mesh of smaller triangles with the same surface.
#pragma once

#include <cstddef>

#include "spincat/geometry/object.h"

namespace spincat {

// Halves the longest edge in all triangles that share it, again and again, until there are `triangles` triangles or
// more, or no edge is longer than `length`. Corners at one place count as one vertex, so that no crack opens when
// vertices are moved later. Triangles with two corners at one place are left out, and so are vertices that no triangle
// uses. Of edges of one length the one that was made first is halved first. Deterministic.
// Preconditions: indices in range; coordinates of moderate size (normalised); length > 0.
Mesh with_split_edges(const Mesh& mesh, std::size_t triangles, double length);

}  // namespace spincat
