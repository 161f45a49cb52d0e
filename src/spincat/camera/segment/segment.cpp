#include "spincat/camera/segment/segment.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "spincat/camera/segment/box.h"
#include "spincat/camera/segment/patches.h"
#include "spincat/error.h"

namespace spincat {
namespace {

constexpr int kGap = 3;  // pixels without a reading that a link may bridge, and the one it leads to

constexpr std::size_t kFewestPixels = 50;  // that an object is told from noise by, however near they are to each other

constexpr float kWide = 0.17F;  // metres, standard deviation: 0.6 m of an even strip

struct Patch {
  Segment segment;
  float depths = 0.0F;     // sum of their squares
  std::size_t on_rim = 0;  // pixels with each of the hints
  std::size_t goes_on = 0;
  std::size_t at_foot = 0;
  std::size_t from_below = 0;
  Eigen::Matrix3f products = Eigen::Matrix3f::Zero();  // sum of p p^T, of points less the patch's first
  Eigen::Vector3f first = Eigen::Vector3f::Zero();

  void start(int u, int v, const Eigen::Vector3f& point) {
    segment.left = segment.right = u;
    segment.top = v;
    first = point;
  }

  void add(int u, int v, const Eigen::Vector3f& point, float height, const PixelHint& hint) {
    ++segment.pixels;
    segment.left = std::min(segment.left, u);
    segment.right = std::max(segment.right, u);
    segment.bottom = v;
    segment.centre += point;
    segment.height = std::max(segment.height, height);
    depths += point.z() * point.z();
    const Eigen::Vector3f d = point - first;
    products += d * d.transpose();
    on_rim += hint.on_rim ? 1 : 0;
    goes_on += hint.goes_on ? 1 : 0;
    at_foot += hint.at_foot ? 1 : 0;
    from_below += hint.from_below ? 1 : 0;
  }

  // Square metres, as its pixels face the camera.
  float area(const Intrinsics& intrinsics) const { return depths / static_cast<float>(intrinsics.fx * intrinsics.fy); }

  // What is no thing on the table but a wall behind it: over the rim and cut by it, or seen to come up from below, or
  // upright and flat, wide or beside the table, and more than is seen.
  bool is_wall(const SupportPlane& table) const {
    const bool is_on_rim = 2 * on_rim > segment.pixels;
    const bool is_beside = 10 * on_rim > 9 * segment.pixels;
    const bool is_cut_by_area = 4 * goes_on * goes_on > segment.pixels;
    return (is_on_rim && is_cut_by_area) || 5 * from_below > 2 * at_foot ||
           ((segment.cut || is_cut_by_area) && is_flat_and_upright(table, is_beside ? 0.0F : kWide));
  }

  // At least so wide, as a standard deviation in metres. Precondition: the segment's centre is that of its points.
  bool is_flat_and_upright(const SupportPlane& table, float width) const {
    constexpr float kUpright = 0.17F;  // cosine of the angle to the table's normal
    const Eigen::Vector3f mean = segment.centre - first;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(products / static_cast<float>(segment.pixels) - mean * mean.transpose());
    const Eigen::Vector3f deviations = solver.eigenvalues().cwiseMax(0.0F).cwiseSqrt();
    return deviations[2] > width && deviations[0] < plane_tolerance(segment.centre.z()) &&
           std::abs(solver.eigenvectors().col(0).dot(table.normal)) < kUpright;
  }
};

// What is known of each patch, by its label.
std::unordered_map<std::uint32_t, Patch> measured(const DepthImage& image, const Intrinsics& intrinsics,
                                                  const SupportPlane& table, const Labels& patches,
                                                  const PixelsOverTable& over, std::vector<std::uint32_t>& order) {
  std::unordered_map<std::uint32_t, Patch> found;
  std::uint32_t last_label = 0;
  Patch* last = nullptr;  // neighbours are mostly of one patch
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::size_t i = image.index(u, v);
      const std::uint32_t label = patches[i];
      if (label == 0) {
        continue;
      }
      const Eigen::Vector3f p = intrinsics.point(u, v, image.depth[i]);
      if (label != last_label) {
        const auto [it, is_new] = found.try_emplace(label);
        last_label = label;
        last = &it->second;
        if (is_new) {
          order.push_back(label);
          last->start(u, v, p);
        }
      }
      last->add(u, v, p, table.height(p), over.hints[i]);
    }
  }
  return found;
}

Labels patches_of(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table, const Labels& over,
                  const SegmentSettings& settings) {
  if (settings.split == SegmentSplit::none) {
    return gather_by_footprint(image, intrinsics, table, over);
  }
  return split_at_grooves(image, intrinsics, linked_patches(image, over, kGap));
}

// Gives each object the box around its pixels.
void add_boxes(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table, Segmentation& result) {
  constexpr float kPixels = 2.5F;       // that a square of the footprint is wide at least
  constexpr float kLeastCell = 0.004F;  // metres
  std::vector<std::vector<Eigen::Vector3f>> points(result.objects.size());
  for (const Segment& object : result.objects) {
    points[object.id - 1U].reserve(object.pixels);
  }
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      if (const std::uint16_t id = result.ids[image.index(u, v)]; id != 0) {
        points[id - 1U].push_back(intrinsics.point(u, v, image.at(u, v)));
      }
    }
  }
  for (Segment& object : result.objects) {
    const float z = object.centre.z();
    const float cell = std::max(kLeastCell, kPixels * z / static_cast<float>(intrinsics.fx));
    object.box = box_on_plane(points[object.id - 1U], table, cell, 2.0F * plane_tolerance(z));
  }
}

}  // namespace

void SegmentSettings::validate() const {
  if (!(least_area >= 0.0F && least_area <= 100.0F)) {
    throw InputError(fmt::format("least area of objects {} m2 is out of range (0 to 100)", least_area));
  }
  if (!(least_height >= 0.0F && least_height < most_height && most_height <= 100.0F)) {
    throw InputError(fmt::format("heights of objects from {} to {} m are out of range (0 to 100, rising)", least_height,
                                 most_height));
  }
}

Segmentation segment(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                     const SegmentSettings& settings) {
  Segmentation result;
  const PixelsOverTable over = pixels_over_table(image, intrinsics, table, settings, result.left_out);
  const Labels patches = patches_of(image, intrinsics, table, over.labels, settings);
  std::vector<std::uint32_t> order;
  std::unordered_map<std::uint32_t, Patch> found = measured(image, intrinsics, table, patches, over, order);
  for (const std::uint32_t label : order) {
    Segment& segment = found[label].segment;
    segment.centre /= static_cast<float>(segment.pixels);
    segment.cut =
        segment.left == 0 || segment.top == 0 || segment.right == image.width - 1 || segment.bottom == image.height - 1;
    if (segment.pixels < kFewestPixels || found[label].area(intrinsics) < settings.least_area) {
      result.left_out.too_few += segment.pixels;
    } else if (segment.height < settings.least_height) {
      result.left_out.too_low += segment.pixels;
    } else if (found[label].is_wall(table)) {
      result.left_out.outside += segment.pixels;
    } else if (result.objects.size() < 65'535) {
      segment.id = static_cast<std::uint16_t>(result.objects.size() + 1);
      result.objects.push_back(segment);
    }
  }
  result.ids.resize(patches.size());
  std::ranges::transform(patches, result.ids.begin(), [&](std::uint32_t label) -> std::uint16_t {
    return label == 0 ? 0 : found[label].segment.id;
  });
  add_boxes(image, intrinsics, table, result);
  result.outline = over.outline;
  return result;
}

}  // namespace spincat
