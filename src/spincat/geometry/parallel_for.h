// A loop over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

#ifdef __SANITIZE_THREAD__
#include <thread>
#include <vector>
#endif

namespace spincat {

// The exception of the smallest index that has one.
class FirstFailure {
 public:
  explicit FirstFailure(std::size_t count) : index_(count) {}

  // Calls body(i); not where a smaller index has failed.
  template <class Body>
  void run(std::size_t i, const Body& body) {
    if (i > index_) {
      return;
    }
    try {
      body(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (i < index_) {
        index_ = i;
        error_ = std::current_exception();
      }
    }
  }

  void rethrow() const {
    if (error_) {
      std::rethrow_exception(error_);
    }
  }

 private:
  std::atomic<std::size_t> index_;
  std::mutex mutex_;  // guards error_
  std::exception_ptr error_;
};

// Calls body(0) to body(count - 1) on `threads` (1 or more) threads, each once, in no particular order. When a call
// throws, those of larger indices are no longer started, and the exception of the smallest index that throws is
// rethrown here: the same one for any number of threads.
template <class Body>
void parallel_for(std::size_t count, int threads, const Body& body) {
  FirstFailure failure(count);
#ifdef __SANITIZE_THREAD__
  // A thread sanitizer does not see the barriers of GCC's OpenMP, and takes what they order for races.
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> crew;
  for (int t = 0; t < threads; ++t) {
    crew.emplace_back([&] {
      for (std::size_t i = next++; i < count; i = next++) {
        failure.run(i, body);
      }
    });
  }
  crew.clear();  // joins
#else
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) {
    failure.run(i, body);
  }
#endif
  failure.rethrow();
}

}  // namespace spincat
