#include "spincat/prepare/point_normals.h"

#include <fmt/format.h>

#include <algorithm>

#include "spincat/error.h"
#include "spincat/prepare/normalise.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/prepare.h"
#include "spincat/range.h"

namespace spincat {

std::vector<Vec3> estimate_normals(std::span<const Vec3> points, int neighbours, const std::optional<Vec3>& towards) {
  check_range("neighbours", neighbours, PrepareSettings::kNeighbours);
  const auto odd = std::ranges::find_if(points, [](const Vec3& p) { return !p.allFinite(); });
  if (odd != points.end()) {
    throw InputError(fmt::format("point {} is not finite", odd - points.begin()));
  }
  const Similarity similarity = unit_similarity(points);
  std::vector<Vec3> scaled(points.size());
  std::ranges::transform(points, scaled.begin(), similarity);
  std::vector<Vec3> normals = estimated_normals(scaled, neighbours);
  if (towards) {
    orient_towards(scaled, similarity(*towards), normals);
  } else {
    orient_outwards(scaled, normals);
  }
  return normals;
}

}  // namespace spincat
