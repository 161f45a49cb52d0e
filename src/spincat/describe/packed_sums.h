// Sums of spin images as bytes, for other ranks. Private: not installed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "spincat/encode/block_sums.h"
#include "spincat/parallel/packing.h"

namespace spincat {

inline std::string pack_sums(const SumsTree& sums) {
  Packer packer;
  for (const SumsNode& node : sums.nodes()) {
    packer.add(static_cast<std::uint64_t>(node.level)).add(std::span<const double>(node.sums));
  }
  return packer.take();
}

// Adds what was packed to the right of what `sums` has.
inline void unpack_sums(std::string_view bytes, SumsTree& sums) {
  for (Unpacker fields(bytes); !fields.empty();) {
    const auto level = static_cast<std::size_t>(fields.get<std::uint64_t>());
    sums.add({level, fields.get_values<double>()});
  }
}

}  // namespace spincat
