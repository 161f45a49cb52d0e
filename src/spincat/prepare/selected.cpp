#include "spincat/prepare/selected.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "spincat/geometry/left_out.h"

namespace spincat {

PointCloud selected(const PointCloud& cloud, std::span<const std::uint32_t> points) {
  if (points.size() == cloud.points.size()) {
    return cloud;
  }
  PointCloud result;
  result.sensor = cloud.sensor;
  result.left_out = cloud.left_out;
  const std::vector<std::uint32_t> rows = rows_of_kept(cloud.points.size(), cloud.left_out);
  const auto before = static_cast<std::ptrdiff_t>(result.left_out.size());
  auto next = points.begin();
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    if (next != points.end() && *next == i) {
      ++next;
    } else {
      result.left_out.push_back(rows[i]);
    }
  }
  std::ranges::inplace_merge(result.left_out, result.left_out.begin() + before);
  for (const std::uint32_t i : points) {
    result.points.push_back(cloud.points[i]);
    if (!cloud.normals.empty()) {
      result.normals.push_back(cloud.normals[i]);
    }
  }
  return result;
}

}  // namespace spincat
