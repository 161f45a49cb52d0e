// Memory for vectorised loops: starts on a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace spincat {

inline constexpr std::size_t kAlignment = 64;  // bytes: a cache line, and the widest vector register in use

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT(google-explicit-constructor): allocators convert
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{kAlignment})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{kAlignment}); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

using AlignedFloats = std::vector<float, AlignedAllocator<float>>;

// The same, but a new array's values are undefined: for memory that is written before it is read.
template <class T>
struct UninitialisedAllocator : AlignedAllocator<T> {
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
};

using UninitialisedFloats = std::vector<float, UninitialisedAllocator<float>>;

}  // namespace spincat
