// Sets of pixels that hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "spincat/camera/segment/segment.h"
#include "spincat/camera/segment/table.h"
#include "spincat/camera/source/frame_source.h"

namespace spincat {

// How far the depths of two neighbouring pixels of one surface may differ at depth z: sensor noise and slope.
inline float link_tolerance(float z) {
  return 0.008F + 0.010F * z * z;
}

// Sets that can be merged (union-find with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  // The smaller root stays one, so that the result does not depend on the order of the calls.
  void merge(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[a < b ? b : a] = a < b ? a : b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Labels of an image's pixels: 0 for none, else the number of a patch.
using Labels = std::vector<std::uint32_t>;

// What a pixel over the table says about whether its surface stands on it.
struct PixelHint {
  bool on_rim : 1;      // over the rim of the table's area
  bool goes_on : 1;     // on the rim, and its surface goes on beside it beyond the rim
  bool at_foot : 1;     // the lowest over the table in its column
  bool from_below : 1;  // at the foot, and its surface comes up from below the table
};

// The pixels over the table that may belong to objects.
struct PixelsOverTable {
  Labels labels;  // 1, others 0
  std::vector<PixelHint> hints;
  std::vector<Eigen::Vector3f> outline;  // TableArea::outline
};

// Counts those that lie outside the table's area.
PixelsOverTable pixels_over_table(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                                  const SegmentSettings& settings, NotObjects& left_out);

// Numbers the patches of the labelled pixels: pixels of one label, at most `gap` apart in a row or column with none of
// their label between, belong together where their depths agree. Patches count from 1 by their first pixels.
Labels linked_patches(const DepthImage& image, const Labels& labels, int gap);

// Parts patches along grooves.
Labels split_at_grooves(const DepthImage& image, const Intrinsics& intrinsics, const Labels& patches);

// Gathers the pixels over the table (labelled 1) by where they stand on it: patches with overlapping or touching
// footprints are one.
Labels gather_by_footprint(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                           const Labels& over_table);

}  // namespace spincat
