#include "fuzz/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> in_use = 0;
std::atomic<std::int64_t> most = 0;

}  // namespace

void* operator new(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  const std::int64_t now = in_use += static_cast<std::int64_t>(malloc_usable_size(memory));
  if (now > most) {
    most = now;
  }
  return memory;
}

void operator delete(void* memory) noexcept {
  if (memory != nullptr) {
    in_use -= static_cast<std::int64_t>(malloc_usable_size(memory));
  }
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

namespace spincat::test {

CountedMemory::CountedMemory() : before_(in_use) {
  ::most = before_;
}

std::int64_t CountedMemory::most() const {
  return ::most - before_;
}

}  // namespace spincat::test
