#include "spincat/prepare/neighbour_distances.h"

#include <cmath>
#include <cstdint>

#include "spincat/geometry/point_tree.h"

namespace spincat {

std::vector<double> neighbour_distances(std::span<const Vec3> points, std::size_t nth) {
  const PointsAdaptor adaptor{points};
  const PointTree tree(3, adaptor, {10});
  std::vector<std::uint32_t> found(nth + 1);  // the point itself is the first
  std::vector<double> squared(nth + 1, 0.0);
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Vec3& p : points) {
    const std::size_t n = tree.knnSearch(p.data(), nth + 1, found.data(), squared.data());
    distances.push_back(std::sqrt(squared[n - 1]));
  }
  return distances;
}

}  // namespace spincat
