// The parts of the pooled pyramid: bands of spin points, and the pyramid of one image. Private to encode.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "spincat/geometry/oriented_points.h"

namespace spincat {

inline constexpr std::size_t kLevels = 3;  // of the pyramid: single cells, sums of 2 x 2, sums of 4 x 4
inline constexpr std::size_t kBands = 4;   // into which the spin points are sorted

// Which of the four bands each spin point belongs to. With g the mean of the surface points, r = |p - g| and
// h = |(p - g) . n|, n the surface's normal at p (the spin image's axis where p is none of its first points): halves by
// r, then each half into halves by h. Both turn with the object, so that the same place on a turned object stays in the
// same band.
std::vector<std::uint8_t> bands_of(const OrientedPoints& surface, const OrientedPoints& spin_points);

// The pyramid of one channel of an image of W x W: three images of W/4 x W/4 cells around alpha = beta = 0, whose cells
// are single bins, sums of 2 x 2 and sums of 4 x 4.
struct Levels {
  explicit Levels(std::size_t image_width) : width(image_width), pairs_(width / 2 * (width / 2)), line_(width) {
    for (std::vector<float>& level : cells) {
      level.resize(width / 4 * (width / 4));
    }
  }

  void reduce(const float* image);

  std::size_t width;
  std::array<std::vector<float>, kLevels> cells;

 private:
  void copy_square(const float* from, std::size_t columns, std::size_t first_row, std::vector<float>& to) const;
  void sum_2x2(const float* from, std::size_t columns, std::vector<float>& to);

  std::vector<float> pairs_;  // sums of 2 x 2 over the whole image
  std::vector<float> line_;
};

}  // namespace spincat
