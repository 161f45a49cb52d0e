// The spin-image engine: a surface made ready once, then images of any oriented points over it.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "spincat/geometry/oriented_points.h"
#include "spincat/spin/params.h"
#include "spincat/spin/spin_images.h"

#pragma GCC visibility push(default)
namespace spincat {

// Makes spin images as docs/how-it-works/spin-images.md defines them. The same bytes come out on every SIMD path and
// however the spin points and the surface are shared out to threads or machines. Const functions may be called by
// several threads at once.
//
//   const SpinImageMaker maker(surface, params);
//   maker.make(spin_points, 0, images);  // room for 64 images: those of spin points 0 to 63
class SpinImageMaker {
 public:
  // Copies the surface and sorts it in space, on `threads` threads: about 10 ms of one for a million points. The
  // environment variable SPINCAT_SIMD forces one of simd_paths(); throws InputError when it names none of them.
  // Precondition: params are valid.
  SpinImageMaker(const OrientedPoints& surface, const SpinImageParams& params, int threads = 1);
  ~SpinImageMaker();

  const SpinImageShape& shape() const;

  // Writes the images of the spin points first, first + 1, ... to `images`: as many as it has room for (a multiple of
  // shape().size() floats; those spin points must exist). Threads share out the images, or, where these are few, the
  // surface.
  void make(const OrientedPoints& spin_points, std::size_t first, std::span<float> images, int threads = 1) const;

  // The same for a run of blocks, each of which says by its place and size which images it wants.
  void make(const OrientedPoints& spin_points, std::span<SpinImageBlock> blocks, int threads = 1) const;

 private:
  class Engine;
  std::unique_ptr<const Engine> engine_;
};

}  // namespace spincat
#pragma GCC visibility pop
