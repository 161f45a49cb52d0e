// The objects on a table, each as a set of pixels.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "spincat/camera/segment/table.h"
#include "spincat/camera/source/depth_image.h"

namespace spincat {

// How readings that hang together are parted into objects.
enum class SegmentSplit {
  concave,    // along grooves: for things that touch or stand on each other, like boxes
  footprint,  // by what stands apart on the table: for things with legs and thin parts, like furniture
};

struct SegmentSettings {
  SegmentSplit split = SegmentSplit::footprint;
  int least_pixels = 300;       // of an object
  float least_height = 0.015F;  // metres over the table that an object reaches
  float most_height = 0.6F;     // metres over the table; what is higher is not looked at

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

// One object, as the camera sees it.
struct Segment {
  std::uint16_t id = 0;  // in Segmentation::ids
  std::size_t pixels = 0;
  int left = 0, top = 0, right = 0, bottom = 0;      // its box of pixels, all inclusive
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  // mean of its points, in metres in the camera's frame
  float height = 0.0F;                               // of its highest point over the table, in metres
  bool cut = false;                                  // touches the picture's border: there may be more of it
};

// Pixels that are no object, by the reason.
struct NotObjects {
  std::size_t outside = 0;  // over the plane, but not over the part of the table that is seen
  std::size_t too_few = 0;  // in patches of less than least_pixels
  std::size_t too_low = 0;  // in patches that stay below least_height
};

struct Segmentation {
  std::vector<std::uint16_t> ids;  // of each pixel: that of its object, or 0
  std::vector<Segment> objects;    // in the order of their ids, 1, 2, ...
  NotObjects left_out;
};

// Finds the objects on the table: pixels over it, linked where their depths agree, parted by `settings.split`. Numbered
// by their first pixels, row by row from the top. Deterministic.
Segmentation segment(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                     const SegmentSettings& settings);

}  // namespace spincat
