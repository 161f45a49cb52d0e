// Which triangles of a mesh share an edge.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// A triangle's way along an edge, whose smaller end is written first.
struct Side {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool forward = false;  // from the smaller end to the larger
};

// The corners of all triangles, with the first vertex at a position in place of all others there.
std::vector<Triangle> merged_corners(const Mesh& mesh);

// Adds the three sides of triangle number `triangle`.
void add_sides(const Triangle& corners, std::uint32_t triangle, std::vector<Side>& sides);

// The two sides of each edge that exactly two of the sides lie on, edge by edge.
std::vector<std::array<Side, 2>> shared_edges(std::vector<Side> sides);

}  // namespace spincat
