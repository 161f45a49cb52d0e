// A surface cut into small groups of neighbouring points with known bounds, so that a kernel can pass
// over those that a spin image cannot see.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/geometry/aligned.h"
#include "spincat/geometry/oriented_points.h"
#include "spincat/spin/support.h"

namespace spincat {

inline constexpr std::size_t kGroupPoints = 32;
inline constexpr std::size_t kTileGroups = 64;

// Bounds of many sets of points, as a structure of arrays: a box around the positions and a box around the normals,
// each given by its centre and its half edges. Arrays are padded to a multiple of 16.
struct Bounds {
  enum Field : std::size_t {
    kX,
    kY,
    kZ,  // centre of the positions
    kHalfX,
    kHalfY,
    kHalfZ,   // half edges
    kRadius,  // half the diagonal
    kNormalX,
    kNormalY,
    kNormalZ,
    kNormalHalfX,
    kNormalHalfY,
    kNormalHalfZ,
    kFields
  };
  std::array<AlignedFloats, kFields> field;
  std::size_t size = 0;

  explicit Bounds(std::size_t count);
};

// The points of a surface in the order of a space-filling curve, in groups of kGroupPoints; kTileGroups groups are a
// tile. The points of group g are six runs of kGroupPoints floats (x, y, z, nx, ny, nz) at group(g). Places left over
// in the last group hold NaN positions, which lie in no support.
class SurfaceGroups {
 public:
  // Sorts only where a support can leave groups out; where it sees the whole surface, the order does not matter. The
  // same for any number of threads.
  SurfaceGroups(const OrientedPoints& surface, const Support& support, int threads);

  std::size_t groups() const { return group_bounds_.size; }
  std::size_t tiles() const { return tile_bounds_.size; }
  const float* group(std::size_t g) const { return points_.data() + g * 6 * kGroupPoints; }
  const Bounds& group_bounds() const { return group_bounds_; }
  const Bounds& tile_bounds() const { return tile_bounds_; }

  // Where a position lies along the curve: neighbours in this order are neighbours in space.
  std::uint32_t curve_key(float x, float y, float z) const;

 private:
  // How coordinates along one axis become cells.
  struct Axis {
    float low = 0.0F;  // of the bounding box
    float cells_per_unit = 0.0F;
    float last = 0.0F;
    std::uint32_t cell(float v) const;
  };

  void choose_cells(const OrientedPoints& surface);
  bool sees_everything(const Support& support) const;
  std::vector<std::uint32_t> curve_keys(const OrientedPoints& surface) const;
  std::vector<std::uint32_t> curve_order(const OrientedPoints& surface) const;
  void fill_tile(std::size_t t, const OrientedPoints& surface, std::span<const std::uint32_t> order);
  void copy_group(std::size_t g, const OrientedPoints& surface, std::span<const std::uint32_t> points);

  unsigned bits_ = 0;  // of a cell's number along each axis
  std::array<Axis, 3> axes_;
  float diagonal_ = 0.0F;  // of the bounding box
  Bounds group_bounds_;
  Bounds tile_bounds_;
  UninitialisedFloats points_;  // groups() x 6 x kGroupPoints
};

}  // namespace spincat
