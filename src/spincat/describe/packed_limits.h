// The limits while reading as bytes, for messages between ranks. Private to the library, not installed.
#pragma once

#include "spincat/io/read_limits.h"
#include "spincat/parallel/packing.h"

namespace spincat {

void fields(auto& archive, MessageOf<ReadLimits> auto& limits) {
  auto& [max_points, max_triangles, max_growth] = limits;  // does not compile when a member is forgotten
  archive(max_points, max_triangles, max_growth);
}

}  // namespace spincat
