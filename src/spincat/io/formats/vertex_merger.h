// Gives equal positions one index. Private to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat::io {

// STL repeats every vertex in each of its triangles; without merging, no triangle would touch another. Positions are
// the same when their three numbers are equal, bit for bit but for the sign of zero. Indices go by first appearance, so
// they do not depend on the hash, whose random key keeps a crafted file from making every look-up slow.
class VertexMerger {
 public:
  VertexMerger();

  // The index of this position in `vertices`, to which it is added when it is new.
  std::uint32_t index_of(const Vec3& position, std::vector<Vec3>& vertices);

 private:
  std::size_t hash(const Vec3& position) const;
  void grow(const std::vector<Vec3>& vertices);

  static constexpr std::uint32_t kEmpty = 0xFFFF'FFFF;

  std::vector<std::uint32_t> slots_;  // indices into vertices, open addressing; the size is a power of two
  std::uint64_t key_;
};

}  // namespace spincat::io
