// Private: a loop over threads.
#pragma once

#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <thread>
#include <vector>
#endif

namespace spincat {

// Calls body(0) to body(count - 1) on up to `threads` threads, each once, in no particular order. `body` must not throw.
template <class Body>
void share_out(std::size_t count, int threads, const Body& body) {
#ifdef __SANITIZE_THREAD__
  // A thread sanitizer does not see the barriers of GCC's OpenMP, and takes what they order for races.
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> crew;
  for (int t = 0; t < threads; ++t) {
    crew.emplace_back([&] {
      for (std::size_t i = next++; i < count; i = next++) {
        body(i);
      }
    });
  }
#else
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) {
    body(i);
  }
#endif
}

}  // namespace spincat
