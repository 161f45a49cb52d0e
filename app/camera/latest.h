// One value handed from a thread to another, the newest only: who makes it never waits, and memory stays bounded.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace spincat::app {

template <class T>
class Latest {
 public:
  // Puts a value in place of the one before. Whether that one had not been taken.
  bool put(T value) {
    bool replaced = false;
    {
      const std::lock_guard lock(mutex_);
      replaced = value_.has_value();
      value_ = std::move(value);
    }
    changed_.notify_all();
    return replaced;
  }

  // No more values will come.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

  // Waits for a value; nothing when the time has passed, or when it is closed and empty.
  std::optional<T> take(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [&] { return value_.has_value() || closed_; });
    return std::exchange(value_, std::nullopt);
  }

  bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_ && !value_.has_value();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<T> value_;
  bool closed_ = false;
};

}  // namespace spincat::app
