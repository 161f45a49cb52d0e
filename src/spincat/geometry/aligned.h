// Aligned memory (oriented_points.h) that is written before it is read.
#pragma once

#include <new>
#include <vector>

#include "spincat/geometry/oriented_points.h"

namespace spincat {

// As AlignedFloats, but a new array's values are undefined: for memory that is written before it is read.
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
