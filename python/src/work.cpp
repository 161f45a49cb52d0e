#include "work.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <system_error>
#include <thread>

namespace py = pybind11;

namespace spincat::python {
namespace {

constexpr std::chrono::milliseconds kLookEvery{50};

// Ends work that nobody wants any more.
struct Unwanted {};

std::thread start(const std::function<void()>& work) {
  try {
    return std::thread(work);
  } catch (const std::system_error&) {
    throw RunError("the system refuses another thread");
  }
}

}  // namespace

void Telling::operator()(std::string_view stage, std::size_t done, std::size_t total) {
  const std::lock_guard lock(mutex_);
  if (stopped_) {
    throw Unwanted();
  }
  if (updates_.empty() || updates_.back().stage != stage) {
    updates_.push_back({std::string(stage), done, total});
  } else {
    updates_.back().done = done;
    updates_.back().total = total;
  }
}

void Telling::check() {
  const std::lock_guard lock(mutex_);
  if (stopped_) {
    throw Unwanted();
  }
}

// The thread of some work, and what the thread that waits for it does.
class WorkThread {
 public:
  WorkThread(const std::function<void(Telling&)>& work, const py::object& progress) : progress_(progress) {
    thread_ = start([this, &work] { run(work); });
  }

  // Called without Python's lock.
  void wait() {
    while (!wait_a_while()) {
      const py::gil_scoped_acquire lock;
      look(true);
    }
    thread_.join();
  }

  // Called with it.
  void finish() {
    if (!failure_) {
      look(false);
    }
    if (raised_) {
      std::rethrow_exception(std::exchange(raised_, nullptr));
    }
    if (failure_) {
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }

 private:
  void run(const std::function<void(Telling&)>& work) {
    try {
      work(telling_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(telling_.mutex_);
    telling_.finished_ = true;
    telling_.finished_changed_.notify_all();
  }

  bool wait_a_while() {
    std::unique_lock lock(telling_.mutex_);
    return telling_.finished_changed_.wait_for(lock, kLookEvery, [&] { return telling_.finished_; });
  }

  // Tells what is new, and whether somebody pressed Ctrl-C.
  void look(bool for_signals) {
    if (raised_) {
      return;
    }
    try {
      tell();
      if (for_signals && PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
    } catch (...) {
      raised_ = std::current_exception();
      const std::lock_guard lock(telling_.mutex_);
      telling_.stopped_ = true;
    }
  }

  void tell() {
    std::vector<Telling::Update> updates;
    {
      const std::lock_guard lock(telling_.mutex_);
      updates.swap(telling_.updates_);
    }
    if (progress_.is_none()) {
      return;
    }
    for (const Telling::Update& update : updates) {
      progress_(update.stage, update.done, update.total);
    }
  }

  const py::object& progress_;
  Telling telling_;
  std::exception_ptr failure_;  // of the work
  std::exception_ptr raised_;   // by Python meanwhile
  std::thread thread_;
};

void run_on_thread(const py::object& progress, const std::function<void(Telling&)>& work) {
  WorkThread thread(work, progress);
  {
    const py::gil_scoped_release unlocked;
    thread.wait();
  }
  thread.finish();
}

namespace {

// The items of share_out, which threads take one after the other.
class Items {
 public:
  Items(std::size_t count, std::string_view stage, Telling& telling, const std::function<void(std::size_t)>& work)
      : count_(count), stage_(stage), telling_(telling), work_(work) {}

  void work_on() {
    for (std::size_t i = take(); i < count_; i = take()) {
      try {
        telling_.check();
        work_(i);
        const std::lock_guard lock(mutex_);
        telling_(stage_, ++done_, count_);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (i < failed_) {
          failed_ = i;
          failure_ = std::current_exception();
        }
      }
    }
  }

  void rethrow() {
    if (failure_) {
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }

 private:
  std::size_t take() {
    const std::lock_guard lock(mutex_);
    return failure_ ? count_ : next_++;
  }

  std::size_t count_;
  std::string_view stage_;
  Telling& telling_;
  const std::function<void(std::size_t)>& work_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::size_t failed_ = static_cast<std::size_t>(-1);  // the first item that did
  std::exception_ptr failure_;
};

}  // namespace

void share_out(std::size_t count, int threads, std::string_view stage, Telling& telling,
               const std::function<void(std::size_t)>& work) {
  Items items(count, stage, telling, work);
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < std::min(count, static_cast<std::size_t>(threads)); ++t) {
    try {
      others.emplace_back([&items] { items.work_on(); });
    } catch (const std::system_error&) {  // those that are there do it
      break;
    }
  }
  items.work_on();
  others.clear();
  items.rethrow();
}

}  // namespace spincat::python
