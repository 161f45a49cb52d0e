// Work cut into steps that are done on several threads and delivered in order.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "spincat/geometry/start_thread.h"

namespace spincat {

// Calls make(step, worker) for every step in [0, steps) on `workers` threads (worker is 0 .. workers - 1, worker 0 on
// the calling thread) and deliver(step, result) for each result on the calling thread, in the order of the steps. At
// most two results a thread are waiting at any time. The first exception of either function stops all work and is
// rethrown here when all threads have ended.
template <class Result>
class InOrder {
 public:
  using Make = std::function<Result(std::size_t step, std::size_t worker)>;
  using Deliver = std::function<void(std::size_t step, Result& result)>;

  InOrder(std::size_t steps, std::size_t workers, Make make, Deliver deliver)
      : steps_(steps), window_(2 * workers), make_(std::move(make)), deliver_(std::move(deliver)) {
    std::vector<std::jthread> others;
    guarded([&] {
      for (std::size_t worker = 1; worker < workers; ++worker) {
        others.push_back(start_thread([this, worker] { guarded([&] { work(worker); }); }));
      }
    });
    guarded([&] { work_and_deliver(); });  // nothing where not all could be started
    others.clear();                        // joins
    if (failure_) {
      std::rethrow_exception(failure_);
    }
  }

 private:
  template <class Function>
  void guarded(Function function) {
    try {
      function();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) {
        failure_ = std::current_exception();
      }
      changed_.notify_all();
    }
  }

  bool may_start() const { return next_ < steps_ && next_ < delivered_ + window_; }

  // Makes the next step. Expects the lock and gives it back.
  void make_next(std::unique_lock<std::mutex>& lock, std::size_t worker) {
    const std::size_t step = next_++;
    lock.unlock();
    Result result = make_(step, worker);
    lock.lock();
    waiting_.emplace(step, std::move(result));
    changed_.notify_all();
  }

  void work(std::size_t worker) {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return failure_ || next_ >= steps_ || may_start(); });
      if (failure_ || next_ >= steps_) {
        return;
      }
      make_next(lock, worker);
    }
  }

  // Delivers what is ready; makes a step itself where nothing is.
  void work_and_deliver() {
    std::unique_lock lock(mutex_);
    while (!failure_ && delivered_ < steps_) {
      const auto ready = waiting_.find(delivered_);
      if (ready != waiting_.end()) {
        Result result = std::move(ready->second);
        waiting_.erase(ready);
        lock.unlock();
        deliver_(delivered_, result);
        lock.lock();
        ++delivered_;
        changed_.notify_all();
      } else if (may_start()) {
        make_next(lock, 0);
      } else {
        changed_.wait(lock);
      }
    }
  }

  const std::size_t steps_;
  const std::size_t window_;  // steps that may be under way or waiting
  const Make make_;
  const Deliver deliver_;

  std::mutex mutex_;  // guards everything below
  std::condition_variable changed_;
  std::size_t next_ = 0;       // first step that nobody has taken
  std::size_t delivered_ = 0;  // steps delivered; written by the calling thread alone
  std::map<std::size_t, Result> waiting_;
  std::exception_ptr failure_;
};

// Calls body(step, worker) for every step in [0, steps), on `workers` threads; exceptions as above.
inline void for_each_step(std::size_t steps, std::size_t workers,
                          const std::function<void(std::size_t step, std::size_t worker)>& body) {
  const auto make = [&](std::size_t step, std::size_t worker) {
    body(step, worker);
    return true;
  };
  InOrder<bool>(steps, std::min(workers, steps), make, [](std::size_t, bool) {});
}

}  // namespace spincat
