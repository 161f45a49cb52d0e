#include "spincat/camera/segment/patches.h"

#include <algorithm>
#include <cmath>

#include "spincat/camera/segment/plane_rays.h"

namespace spincat {
namespace {

// Below this height a reading may be the table's own.
float least_height_over_table(float z) {
  return 0.003F + 0.004F * z * z;
}

// Whether a pixel on the rim has a neighbour beyond it at the same depth.
bool goes_on_at(const DepthImage& image, const std::vector<std::uint8_t>& is_beyond, int u, int v) {
  const float z = image.at(u, v);
  const auto is_continued_at = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < image.width && y < image.height && is_beyond[image.index(x, y)] != 0 &&
           std::abs(z - image.at(x, y)) < link_tolerance(z);
  };
  return is_continued_at(u - 1, v) || is_continued_at(u + 1, v) || is_continued_at(u, v - 1) ||
         is_continued_at(u, v + 1);
}

// Whether the surface at a pixel at the foot is seen below the table, too, as a wall's is behind its edge: the first
// reading below it and some more after that, so that no noise passes for it.
bool comes_from_below(const DepthImage& image, const Intrinsics& intrinsics, const PlaneRays& rays, int u, int v) {
  constexpr int kMore = 6;  // rows
  const float z = image.at(u, v);
  const auto is_below = [&](int y) {
    return image.at(u, y) > 0.0F && rays.height(u, y, image.at(u, y)) < -plane_tolerance(z);
  };
  const int reach = pixels_of(4.0F * plane_tolerance(z), z, intrinsics.fy, 1);
  for (int y = v + 1; y <= std::min(v + reach, image.height - 1 - kMore); ++y) {
    if (is_below(y)) {
      return std::abs(image.at(u, y) - z) < 2.0F * link_tolerance(z) && is_below(y + kMore / 2) && is_below(y + kMore);
    }
  }
  return false;
}

}  // namespace

PixelsOverTable pixels_over_table(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                                  const SegmentSettings& settings, NotObjects& left_out) {
  const TableArea area(image, intrinsics, table);
  const PlaneRays rays(image.width, image.height, intrinsics, table, area.x_axis(), area.y_axis());
  PixelsOverTable over{Labels(image.depth.size(), 0), std::vector<PixelHint>(image.depth.size(), PixelHint{}),
                       area.outline()};
  std::vector<std::uint8_t> is_beyond(image.depth.size(), 0);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const float z = image.at(u, v);
      const float height = rays.height(u, v, z);
      if (!(z > 0.0F) || height < least_height_over_table(z)) {
        continue;
      }
      const std::size_t i = image.index(u, v);
      const TableArea::Place place = area.place_at(z * rays.at(u, v).head<2>().matrix());
      over.hints[i].on_rim = place == TableArea::Place::rim;
      if (place == TableArea::Place::outside) {
        ++left_out.outside;
        is_beyond[i] = 1;
      } else if (height > settings.most_height) {
        ++left_out.too_high;
        is_beyond[i] = 1;
      } else {
        over.labels[i] = 1;
      }
    }
  }
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::size_t i = image.index(u, v);
      if (over.labels[i] == 0) {
        continue;
      }
      PixelHint& hint = over.hints[i];
      hint.goes_on = hint.on_rim && goes_on_at(image, is_beyond, u, v);
      hint.at_foot = v + 1 < image.height && over.labels[image.index(u, v + 1)] == 0;
      hint.from_below = hint.at_foot && comes_from_below(image, intrinsics, rays, u, v);
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
