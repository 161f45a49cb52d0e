// Point clouds that keep the order of a camera's pixels.
#pragma once

#include <string_view>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/io/read_limits.h"

namespace spincat {

// width x height points, row by row; where nothing was measured a coordinate is not finite.
struct OrganizedCloud {
  int width = 0;
  int height = 0;
  std::vector<Vec3> points;
};

// Reads the bytes of a PCD file whose points make up a picture (HEIGHT above 1). Throws InputError (without a file
// name) when it is none, damaged, larger than 8,192 x 8,192, or packed so well that it would take more memory than
// limits.max_growth lets a file of its size take.
OrganizedCloud read_organized_pcd(std::string_view bytes, const ReadLimits& limits = {});

}  // namespace spincat
