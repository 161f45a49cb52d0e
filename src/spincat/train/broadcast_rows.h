// Private to the library, not installed: how ranks know again what they were given.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "spincat/parallel/packing.h"

namespace spincat {

// The rows of a feature table that all ranks of the farm have taken while its objects were described.
struct BroadcastRows {
  std::uint64_t id = 0;                // by which they know them again; 0: they have none
  std::vector<std::uint32_t> objects;  // which of the described objects the table's are, ascending
};

void fields(auto& archive, MessageOf<BroadcastRows> auto& rows) {
  auto& [id, objects] = rows;
  archive(id, objects);
}

// 1, 2, ...: another one at each call in this process. Nothing that is written may depend on it.
inline std::uint64_t next_broadcast_id() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace spincat
