// What the tests of external surfaces and of even draws look at.
#pragma once

#include <cmath>
#include <cstdint>

#include "spincat/prepare/external_surface.h"
#include "support/shapes.h"

namespace spincat::test {

inline SurfacePoints seen_of(const Mesh& mesh, std::uint64_t seed = 1) {
  Random random(seed);
  return external_surface(mesh, random);
}

// A box that fits into the unit sphere, as test::box.
inline Mesh unit_box() {
  return scaled(box(), 2.0 / std::sqrt(3.0));
}

}  // namespace spincat::test
