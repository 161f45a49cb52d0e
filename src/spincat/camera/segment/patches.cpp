#include "spincat/camera/segment/patches.h"

#include <algorithm>
#include <cmath>

namespace spincat {
namespace {

// Below this height a reading may be the table's own.
float least_height_over_table(float z) {
  return 0.003F + 0.004F * z * z;
}

}  // namespace

Labels pixels_over_table(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                         const SegmentSettings& settings, NotObjects& left_out) {
  const TableArea area(image, intrinsics, table);
  Labels over(image.depth.size(), 0);
  std::vector<float> across(
      static_cast<std::size_t>(image.width));  // the part of height / z that depends on the column
  for (int u = 0; u < image.width; ++u) {
    across[static_cast<std::size_t>(u)] = table.normal.x() * static_cast<float>((u - intrinsics.cx) / intrinsics.fx);
  }
  for (int v = 0; v < image.height; ++v) {
    const float down = table.normal.y() * static_cast<float>((v - intrinsics.cy) / intrinsics.fy) + table.normal.z();
    for (int u = 0; u < image.width; ++u) {
      const float z = image.at(u, v);
      const float height = z * (across[static_cast<std::size_t>(u)] + down) + table.offset;
      if (!(z > 0.0F) || height < least_height_over_table(z) || height > settings.most_height) {
        continue;
      }
      if (area.contains(intrinsics.point(u, v, z))) {
        over[image.index(u, v)] = 1;
      } else {
        ++left_out.outside;
      }
    }
  }
  return over;
}

Labels linked_patches(const DepthImage& image, const Labels& labels, int gap) {
  DisjointSets sets(labels.size());
  const auto link_to_next = [&](int u, int v, int du, int dv) {
    const std::size_t i = image.index(u, v);
    for (int k = 1; k <= gap; ++k) {
      const int u2 = u + k * du;
      const int v2 = v + k * dv;
      if (u2 >= image.width || v2 >= image.height) {
        return;
      }
      const std::size_t j = image.index(u2, v2);
      if (labels[j] == labels[i]) {
        if (std::abs(image.depth[i] - image.depth[j]) < link_tolerance(image.depth[i])) {
          sets.merge(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        }
        return;
      }
    }
  };
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      if (labels[image.index(u, v)] != 0) {
        link_to_next(u, v, 1, 0);
        link_to_next(u, v, 0, 1);
      }
    }
  }
  // A root is its set's first pixel: it comes before all others.
  Labels patches(labels.size(), 0);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != 0) {
      const std::uint32_t root = sets.find(i);
      patches[i] = root == i ? ++count : patches[root];
    }
  }
  return patches;
}

}  // namespace spincat
