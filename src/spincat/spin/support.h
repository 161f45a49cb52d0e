// The support of a spin image as thresholds on what is cheap to compute.
#pragma once

#include "spincat/spin/params.h"

namespace spincat {

// Everything a kernel has to know about the parameters, in single precision.
//
// The definition (reference.cpp) compares row and column with the image's borders. Both are monotone in beta and in
// alpha^2, rounding included, so the comparisons are turned into exact limits on beta and alpha^2 themselves: the same
// pairs are accepted, bit for bit, but the square root is taken only of those that are.
struct Support {
  explicit Support(const SpinImageParams& params);  // precondition: params are valid

  SpinConvention convention;
  Binning binning;
  bool soft;              // two channels by the squared cosine
  bool tests_angle;       // least_cosine leaves something out
  float width;            // W
  float bins_per_unit;    // 1 / b
  float least_beta;       // a pair counts when least_beta <= beta <= most_beta,
  float most_beta;        //
  float most_alpha2;      // alpha^2 <= most_alpha2,
  float least_cosine;     // n . m (pcl: |n . m|) >= least_cosine
  float least_distance2;  // and, in the pcl convention, |d|^2 >= least_distance2

  // Cells a point can fall into (not the image's: those also take their neighbours' shares).
  std::size_t cell_rows;
  std::size_t cell_columns;
};

}  // namespace spincat
