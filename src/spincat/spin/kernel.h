// The inner loops of the spin-image engine, one set of functions for each SIMD instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/spin/support.h"
#include "spincat/spin/surface_groups.h"

namespace spincat {

inline constexpr std::size_t kTilesAtOnce = 8;  // so many stay in a second-level cache

// The oriented point an image is made for.
struct SpinPoint {
  float x, y, z, nx, ny, nz;
};

// How the sums of one image are laid out while it is made. A cell holds sums over the points that fell into it, as
// integers in units of 2^-23: exact, so that they come out the same in whatever order and on however many threads they
// are added. Bilinear binning sums the moments 1, u, v, uv of the place (u, v) in the cell, from which the shares of
// the four neighbours follow; nearest binning sums 1. A soft angle test sums the same once more, weighted by the
// squared cosine. All sums but those of 1 have a known bias (kernel_places-inl.h).
//
//   bilinear        [cell][1 u v uv]
//   bilinear, soft  [plain, weighted][cell][1 u v uv]
//   nearest         [cell]
//   nearest, soft   [cell][plain, weighted]
struct CellLayout {
  explicit CellLayout(const Support& support);

  std::size_t row_stride;    // cells from one row to the next: a multiple of 8
  std::size_t plane_stride;  // integers from one plane to the next
  std::size_t size;          // integers in all
};

struct SpinKernel {
  std::string_view name;  // of the path, as in SPINCAT_SIMD

  // Writes the numbers of the tiles that may hold a point in the support of `p`, rising, to `tiles` (room for all) and
  // returns how many there are.
  std::size_t (*select_tiles)(const SurfaceGroups& surface, const Support& support, const SpinPoint& p,
                              std::uint32_t* tiles);

  // Adds to `cells` what the points of these tiles, at most kTilesAtOnce, contribute to the image of `p`.
  void (*accumulate)(const SurfaceGroups& surface, const Support& support, const SpinPoint& p,
                     std::span<const std::uint32_t> tiles, std::int64_t* cells);

  // Turns the sums into the image (SpinImageShape of the parameters) and sets them to zero again.
  void (*finish)(const Support& support, std::int64_t* cells, std::span<float> image);
};

// The names of the paths that this machine can run, the fastest first: avx512, avx2, sse4, ssse3, portable; neon, ...
const std::vector<std::string>& simd_paths();

// The path that the environment variable SPINCAT_SIMD names, or the fastest when it is not set or empty.
// Throws InputError that lists the names when it names none of simd_paths().
const SpinKernel& spin_kernel();

}  // namespace spincat
