// A loop over threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "spincat/geometry/start_thread.h"

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

  // Something else went wrong: no call is started any more, and this is rethrown.
  void stop(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    index_ = 0;
    error_ = std::move(error);
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

// Calls body(0) to body(count - 1) on `threads` (1 or more) threads, this one among them, each once, in no particular
// order. When a call throws, those of larger indices are no longer started, and the exception of the smallest index
// that throws is rethrown here: the same one for any number of threads. Throws RunError when a thread cannot be
// started.
template <class Body>
void parallel_for(std::size_t count, int threads, const Body& body) {
  FirstFailure failure(count);
  std::atomic<std::size_t> next = 0;
  const auto run_all = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      failure.run(i, body);
    }
  };
  std::vector<std::jthread> others;
  try {
    for (std::size_t t = 1; t < std::min(static_cast<std::size_t>(threads), count); ++t) {
      others.push_back(start_thread(run_all));
    }
    run_all();
  } catch (...) {
    next = count;
    failure.stop(std::current_exception());
  }
  others.clear();  // joins
  failure.rethrow();
}

}  // namespace spincat
