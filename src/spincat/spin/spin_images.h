// Spin images: K images of one shape in one buffer.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "spincat/geometry/oriented_points.h"
#include "spincat/spin/params.h"

#pragma GCC visibility push(default)
namespace spincat {

// `count` images of `shape`, one after the other; image k begins at k * shape.size().
//
//   value of channel c, row i, column j of image k:   images.image(k)[(c * rows + i) * columns + j]
class SpinImages {
 public:
  SpinImages() = default;
  SpinImages(std::size_t count, SpinImageShape shape)
      : count_(count), shape_(shape), values_(count * shape.size(), 0.0F) {}

  std::size_t count() const { return count_; }
  const SpinImageShape& shape() const { return shape_; }
  std::span<float> image(std::size_t k) { return {values_.data() + k * shape_.size(), shape_.size()}; }
  std::span<const float> image(std::size_t k) const { return {values_.data() + k * shape_.size(), shape_.size()}; }
  std::span<float> values() { return values_; }
  std::span<const float> values() const { return values_; }

 private:
  std::size_t count_ = 0;
  SpinImageShape shape_;
  AlignedFloats values_;
};

// Consecutive images of an object: those of the spin points first, first + 1, ..., first + images.count() - 1.
struct SpinImageBlock {
  std::size_t first = 0;
  SpinImages images;
};

using SpinImageConsumer = std::function<void(const SpinImageBlock&)>;

// How many spin points one block has. It is part of what a result is made of (sums are combined block by block), so it
// never depends on the number of threads or ranks.
inline constexpr std::size_t kSpinImageBlock = 64;

// Makes the image of every spin point from all surface points, on `threads` threads (1 or more), and hands them on in
// order, block by block, on the calling thread. Blocks of 16 MB together are made at a time (one block where that is
// larger), and never more than two such lots a thread are held. The same bytes for any number of threads. What the
// consumer throws ends the work and arrives here. Throws InputError when the environment variable SPINCAT_SIMD names no
// path of this machine (spin_image_maker.h). Precondition: params are valid. Source: paper, equations 1 and 2.
void make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points, const SpinImageParams& params,
                      const SpinImageConsumer& consume, int threads = 1);

// The same, all images kept: for those who ask for the images themselves.
SpinImages make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points,
                            const SpinImageParams& params, int threads = 1);

}  // namespace spincat
#pragma GCC visibility pop
