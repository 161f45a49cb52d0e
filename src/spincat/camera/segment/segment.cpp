#include "spincat/camera/segment/segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "spincat/camera/segment/patches.h"
#include "spincat/error.h"

namespace spincat {
namespace {

constexpr int kGap = 3;  // pixels without a reading that a link may bridge, and the one it leads to

// What is known of each patch, by its label.
std::unordered_map<std::uint32_t, Segment> measured(const DepthImage& image, const Intrinsics& intrinsics,
                                                    const SupportPlane& table, const Labels& patches,
                                                    std::vector<std::uint32_t>& order) {
  std::unordered_map<std::uint32_t, Segment> found;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::uint32_t label = patches[image.index(u, v)];
      if (label == 0) {
        continue;
      }
      const auto [it, is_new] = found.try_emplace(label);
      Segment& segment = it->second;
      if (is_new) {
        order.push_back(label);
        segment.left = segment.right = u;
        segment.top = v;
      }
      const Eigen::Vector3f p = intrinsics.point(u, v, image.at(u, v));
      ++segment.pixels;
      segment.left = std::min(segment.left, u);
      segment.right = std::max(segment.right, u);
      segment.bottom = v;
      segment.centre += p;
      segment.height = std::max(segment.height, table.height(p));
    }
  }
  return found;
}

Labels patches_of(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                  const SegmentSettings& settings, NotObjects& left_out) {
  const Labels over = pixels_over_table(image, intrinsics, table, settings, left_out);
  if (settings.split == SegmentSplit::none) {
    return gather_by_footprint(image, intrinsics, table, over);
  }
  return split_at_grooves(image, intrinsics, linked_patches(image, over, kGap));
}

}  // namespace

void SegmentSettings::validate() const {
  if (least_pixels < 1 || least_pixels > 1'000'000'000) {
    throw InputError(fmt::format("least number of pixels {} is out of range (1 to 1000000000)", least_pixels));
  }
  if (!(least_height >= 0.0F && least_height < most_height && most_height <= 100.0F)) {
    throw InputError(fmt::format("heights of objects from {} to {} m are out of range (0 to 100, rising)", least_height,
                                 most_height));
  }
}

Segmentation segment(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                     const SegmentSettings& settings) {
  Segmentation result;
  const Labels patches = patches_of(image, intrinsics, table, settings, result.left_out);
  std::vector<std::uint32_t> order;
  std::unordered_map<std::uint32_t, Segment> found = measured(image, intrinsics, table, patches, order);
  for (const std::uint32_t label : order) {
    Segment& segment = found[label];
    if (segment.pixels < static_cast<std::size_t>(settings.least_pixels)) {
      result.left_out.too_few += segment.pixels;
    } else if (segment.height < settings.least_height) {
      result.left_out.too_low += segment.pixels;
    } else if (result.objects.size() < 65'535) {
      segment.id = static_cast<std::uint16_t>(result.objects.size() + 1);
      segment.centre /= static_cast<float>(segment.pixels);
      segment.cut = segment.left == 0 || segment.top == 0 || segment.right == image.width - 1 ||
                    segment.bottom == image.height - 1;
      result.objects.push_back(segment);
    }
  }
  result.ids.resize(patches.size());
  std::ranges::transform(patches, result.ids.begin(),
                         [&](std::uint32_t label) -> std::uint16_t { return label == 0 ? 0 : found[label].id; });
  return result;
}

}  // namespace spincat
