// Numbers by which ranks know again what they were given.
#pragma once

#include <atomic>
#include <cstdint>

namespace spincat {

// 1, 2, ...: another one at each call in this process. Nothing that is written may depend on it.
inline std::uint64_t next_broadcast_id() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace spincat
