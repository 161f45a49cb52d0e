#include "app/camera/camera_state.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace spincat::app {

void CameraState::show(std::shared_ptr<const ShownFrame> frame) {
  {
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
    ++number_;
  }
  changed_.notify_all();
}

void CameraState::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
}

CameraState::Shown CameraState::newer_than(std::uint64_t after, std::chrono::milliseconds longest) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, longest, [&] { return number_ > after || ended_; });
  return {number_, number_ > after ? frame_ : nullptr, ended_};
}

void lower_priority() {
  constexpr int kNice = 10;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice));  // Linux: of this thread alone
}

}  // namespace spincat::app
