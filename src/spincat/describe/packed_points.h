// Points and parameters of spin images as bytes, for other ranks. Private: not installed.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "spincat/geometry/oriented_points.h"
#include "spincat/parallel/packing.h"
#include "spincat/spin/params.h"

namespace spincat {

inline void fields(Packer& packer, const OrientedPoints& p) {
  for (const auto array : {p.x(), p.y(), p.z(), p.nx(), p.ny(), p.nz()}) {
    packer.add(array);
  }
}

inline void fields(Unpacker& unpacker, OrientedPoints& points) {
  std::array<std::vector<float>, 6> arrays;
  for (std::vector<float>& array : arrays) {
    unpacker(array);
  }
  const auto& [x, y, z, nx, ny, nz] = arrays;
  points = OrientedPoints(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.set(i, {x[i], y.at(i), z.at(i)}, {nx.at(i), ny.at(i), nz.at(i)});
  }
}

void fields(auto& archive, MessageOf<SpinImageParams> auto& params) {
  auto& [convention, image_width, bin_size, support_angle, binning, angle_test] = params;  // all of them
  archive(convention, image_width, bin_size, support_angle, binning, angle_test);
}

}  // namespace spincat
