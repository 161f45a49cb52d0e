// The parameters of a spin image, as the paper names them, and the shape of the image that they ask for.
#pragma once

#include <cstddef>
#include <limits>

#include "spincat/range.h"

#pragma GCC visibility push(default)
namespace spincat {

// How a pair of points becomes a place in the image; docs/how-it-works/spin-images.md has the exact formulas of both.
enum class SpinConvention {
  johnson,  // Johnson's: W x W, rows fall with beta, columns grow with alpha, signed support angle
  pcl,      // as pcl::SpinImageEstimation 1.13 does it: (W + 1) x (2 W + 1), rows grow with alpha, normalised
};

enum class Binning {
  bilinear,  // a point's weight is shared between the four nearest cells (Johnson)
  nearest,   // all of it goes to the cell it falls into
};

enum class AngleTest {
  cutoff,  // a point counts when the angle between the normals is within the support angle: one channel
  soft,    // every point counts: (n . m)^2 of it in channel 0 and the rest in channel 1; no support angle
};

// Rows and columns of one image, and the channels it has; stored channel by channel, row by row.
struct SpinImageShape {
  std::size_t channels = 0;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t size() const { return channels * rows * columns; }
  friend bool operator==(const SpinImageShape&, const SpinImageShape&) = default;
};

struct SpinImageParams {
  SpinConvention convention = SpinConvention::johnson;
  int image_width = 20;         // W, in bins
  double bin_size = 0.1;        // b, in the unit of the points
  double support_angle = 60.0;  // A, in degrees; 180 switches the test off (johnson), and so does 90 (pcl)
  Binning binning = Binning::bilinear;
  AngleTest angle_test = AngleTest::cutoff;

  static constexpr Range kImageWidth{1, 256};
  static constexpr Range kBinSize{0.0, std::numeric_limits<double>::infinity(), true};
  static constexpr Range kSupportAngle{0.0, 180.0};  // to 90 in the pcl convention

  // D = W b: how far from the spin point's normal line a point may lie and still count.
  double support_distance() const { return image_width * bin_size; }
  SpinImageShape shape() const;
  // cos A in single precision: the least n . m (johnson) or |n . m| (pcl) with which a point counts. Minus infinity and
  // zero where no angle is left out; exactly zero at 90 degrees.
  float least_cosine() const;

  // Throws InputError naming the field, its value and the allowed range. The pcl convention knows only bilinear
  // binning with the cutoff.
  void validate() const;
};

// The bin size with which the pcl convention covers PCL's search radius R: R / (W sqrt 2).
double pcl_bin_size(double search_radius, int image_width);

}  // namespace spincat
#pragma GCC visibility pop
