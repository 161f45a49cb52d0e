// Convex hulls of cells.
#pragma once

#include <vector>

namespace spincat {

struct GridPoint {
  int x;
  int y;
  auto operator<=>(const GridPoint&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer
};

// The corners of the convex hull, counter-clockwise. Precondition: there is a point.
std::vector<GridPoint> convex_hull(std::vector<GridPoint> points);

// Whether the point lies in the hull or on its border.
bool is_inside(const std::vector<GridPoint>& hull, const GridPoint& point);

}  // namespace spincat
