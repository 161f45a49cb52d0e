// Sums of spin images as bytes, for other ranks. Private: not installed.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/encode/block_sums.h"
#include "spincat/parallel/packing.h"

namespace spincat {

void fields(auto& archive, MessageOf<SumsNode> auto& node) {
  auto& [level, sums] = node;  // does not compile when a member is forgotten
  archive(level, sums);
}

inline std::string pack_sums(const SumsTree& sums) {
  return pack(sums.nodes());
}

// Adds what was packed to the right of what `sums` has.
inline void unpack_sums(std::string_view bytes, SumsTree& sums) {
  for (SumsNode& node : unpack<std::vector<SumsNode>>(bytes)) {
    sums.add(std::move(node));
  }
}

}  // namespace spincat
