// Whether three columns after x y z are normals or colours: only the numbers tell. Private to io.
#pragma once

#include <cmath>

#include "spincat/geometry/object.h"

namespace spincat::io {

// In a file of normals each has unit length, or is zero or not finite where it is not known.
class UnitNormals {
 public:
  bool possible() const { return possible_; }
  bool found() const { return possible_ && seen_; }
  void rule_out() { possible_ = false; }
  void look_at(const Vec3& vector) {
    constexpr double kTolerance = 1e-2;
    const double length = vector.norm();
    if (std::abs(length - 1) <= kTolerance) {
      seen_ = true;
    } else if (std::isfinite(length) && length != 0) {
      possible_ = false;
    }
  }

 private:
  bool possible_ = true;
  bool seen_ = false;
};

}  // namespace spincat::io
