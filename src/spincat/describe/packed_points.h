// Points and parameters of spin images as bytes, for other ranks. Private: not installed.
#pragma once

#include "spincat/geometry/oriented_points.h"
#include "spincat/parallel/packing.h"
#include "spincat/spin/params.h"

namespace spincat {

inline void pack_points(Packer& packer, const OrientedPoints& p) {
  for (const auto array : {p.x(), p.y(), p.z(), p.nx(), p.ny(), p.nz()}) {
    packer.add(array);
  }
}

inline OrientedPoints unpack_points(Unpacker& fields) {
  const auto x = fields.get_values<float>();
  const auto y = fields.get_values<float>();
  const auto z = fields.get_values<float>();
  const auto nx = fields.get_values<float>();
  const auto ny = fields.get_values<float>();
  const auto nz = fields.get_values<float>();
  OrientedPoints points(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.set(i, {x[i], y.at(i), z.at(i)}, {nx.at(i), ny.at(i), nz.at(i)});
  }
  return points;
}

inline void pack_params(Packer& packer, const SpinImageParams& p) {
  packer.add(p.convention).add(p.image_width).add(p.bin_size).add(p.support_angle).add(p.binning).add(p.angle_test);
}

inline SpinImageParams unpack_params(Unpacker& fields) {
  SpinImageParams p;
  p.convention = fields.get<SpinConvention>();
  p.image_width = fields.get<int>();
  p.bin_size = fields.get<double>();
  p.support_angle = fields.get<double>();
  p.binning = fields.get<Binning>();
  p.angle_test = fields.get<AngleTest>();
  return p;
}

}  // namespace spincat
