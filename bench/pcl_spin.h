// The peer in the race: pcl::SpinImageEstimation, where PCL is installed. Kept behind a plain interface, since PCL's
// headers are heavy and must be compiled with its own flags.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "spincat/geometry/oriented_points.h"

namespace spincat::bench {

class __attribute__((visibility("default"))) PclSpinImages {
 public:
  // Copies the cloud and builds PCL's kd-tree (unsorted results): not part of what is timed.
  explicit PclSpinImages(const OrientedPoints& surface);
  ~PclSpinImages();

  // Images of the surface points `chosen` (all when empty) with PCL's defaults: rectangular, not angular. Width 10
  // or 20. Returns a number that depends on all images.
  double run(const std::vector<int>& chosen, int image_width, double search_radius, double least_cosine) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace spincat::bench
