// Long work, during which Python goes on: other threads of it run, progress is told, and Ctrl-C ends it.
#pragma once

#include <pybind11/pybind11.h>
#include <spincat/spincat.h>

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spincat::python {

// What work tells of itself, and how it learns that nobody wants it any more. Any thread may use it.
class Telling {
 public:
  // Throws where the work is to end. What it throws is for run_on_thread alone.
  void operator()(std::string_view stage, std::size_t done, std::size_t total);
  void check();
  Progress progress() {
    return [this](std::string_view stage, std::size_t done, std::size_t total) { (*this)(stage, done, total); };
  }
  // How the library is to work while it tells.
  Execution execution(int threads, bool strict) {
    Execution result;
    result.threads = threads;
    result.strict = strict;
    result.progress = progress();
    return result;
  }

 private:
  friend class WorkThread;
  struct Update {
    std::string stage;
    std::size_t done = 0;
    std::size_t total = 0;
  };

  std::mutex mutex_;
  std::condition_variable finished_changed_;
  std::vector<Update> updates_;  // not told yet, the last one of each stage
  bool stopped_ = false;
  bool finished_ = false;
};

// Runs `work` on a thread of its own, without Python's lock. Meanwhile this thread hands on what it tells to `progress`
// (None, or a function of stage, done and total) and looks for signals. What either raises ends the work, and is raised
// when it has ended. What the work throws arrives here.
void run_on_thread(const pybind11::object& progress, const std::function<void(Telling&)>& work);

// The same for work that returns something.
template <class Work>
auto run_work(const pybind11::object& progress, Work&& work) {
  std::optional<decltype(work(std::declval<Telling&>()))> result;
  run_on_thread(progress, [&](Telling& telling) { result.emplace(work(telling)); });
  return *std::move(result);
}

// Calls work(i) for every i below `count` on so many threads. All of those that come before one that throws are done,
// so that it is always the same error that arrives. Tells `stage` how many are done.
void share_out(std::size_t count, int threads, std::string_view stage, Telling& telling,
               const std::function<void(std::size_t)>& work);

}  // namespace spincat::python
