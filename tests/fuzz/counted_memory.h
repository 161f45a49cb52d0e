// Counts the memory that the program takes, its libraries included, so that limits on it can be tested.
#pragma once

#include <cstdint>

namespace spincat::test {

// The most memory in use, in bytes, since this was made, beyond what was in use then. All threads count; one at a time.
class CountedMemory {
 public:
  CountedMemory();
  std::int64_t most() const;

 private:
  std::int64_t before_;
};

}  // namespace spincat::test
