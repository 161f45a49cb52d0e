// The limits while reading as bytes, for messages between ranks. Private to the library, not installed.
#pragma once

#include <cstdint>

#include "spincat/io/read_limits.h"
#include "spincat/parallel/packing.h"

namespace spincat {

inline void pack_limits(Packer& packer, const ReadLimits& limits) {
  for (const std::uint64_t limit : {limits.max_points, limits.max_triangles, limits.max_growth}) {
    packer.add(limit);
  }
}

inline ReadLimits unpack_limits(Unpacker& fields) {
  ReadLimits limits;
  limits.max_points = fields.get<std::uint64_t>();
  limits.max_triangles = fields.get<std::uint64_t>();
  limits.max_growth = fields.get<std::uint64_t>();
  return limits;
}

}  // namespace spincat
