// Point clouds that keep the order of a camera's pixels.
#pragma once

#include <string_view>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// width x height points, row by row; where nothing was measured a coordinate is not finite.
struct OrganizedCloud {
  int width = 0;
  int height = 0;
  std::vector<Vec3> points;
};

// Reads the bytes of a PCD file whose points make up a picture (HEIGHT above 1). Throws InputError (without a file
// name) when it is none, damaged, or larger than 8,192 x 8,192. Memory stays within a few times the file.
OrganizedCloud read_organized_pcd(std::string_view bytes);

}  // namespace spincat
