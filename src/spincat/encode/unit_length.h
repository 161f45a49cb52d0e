// Scaling a part of a feature vector to length 1. Private to encode.
#pragma once

#include <cmath>
#include <span>

namespace spincat {

// Scales `values` to length `length`; all zeros stay zeros.
inline void scale_to_length(std::span<double> values, double length) {
  double squared = 0.0;
  for (const double v : values) {
    squared += v * v;
  }
  const double factor = squared > 0.0 ? length / std::sqrt(squared) : 0.0;
  for (double& v : values) {
    v *= factor;
  }
}

}  // namespace spincat
