#include "spincat/camera/segment/hull.h"

#include <algorithm>
#include <cstddef>

namespace spincat {
namespace {

long long cross(const GridPoint& o, const GridPoint& a, const GridPoint& b) {
  return static_cast<long long>(a.x - o.x) * (b.y - o.y) - static_cast<long long>(a.y - o.y) * (b.x - o.x);
}

}  // namespace

// Andrew's monotone chain.
std::vector<GridPoint> convex_hull(std::vector<GridPoint> points) {
  std::ranges::sort(points);
  std::vector<GridPoint> hull(2 * points.size() + 1);
  std::size_t k = 0;
  const auto add = [&](const GridPoint& p, std::size_t fixed) {
    while (k >= fixed + 2 && cross(hull[k - 2], hull[k - 1], p) <= 0) {
      --k;
    }
    hull[k++] = p;
  };
  for (const GridPoint& p : points) {
    add(p, 0);
  }
  const std::size_t lower = k - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) {
    add(*p, lower);
  }
  hull.resize(std::max<std::size_t>(k - 1, 1));
  return hull;
}

bool is_inside(const std::vector<GridPoint>& hull, const GridPoint& point) {
  for (std::size_t k = 0; k < hull.size(); ++k) {
    if (cross(hull[k], hull[(k + 1) % hull.size()], point) < 0) {
      return false;
    }
  }
  return true;
}

}  // namespace spincat
