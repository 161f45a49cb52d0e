#include "spincat/parallel/thread_crew.h"

#include <exception>
#include <new>
#include <utility>

#include "spincat/error.h"
#include "spincat/geometry/start_thread.h"

namespace spincat {

void TaskResult::throw_problem() const {
  if (outcome == Outcome::bad_input) {
    throw InputError(file, bytes);
  }
  throw RunError(file, bytes);
}

ThreadCrew::ThreadCrew(Work work, int threads) : work_(std::move(work)) {
  try {
    for (int t = 0; t < threads; ++t) {
      threads_.push_back(start_thread([this] { work_on(); }));
    }
  } catch (...) {
    stop();  // or those that were started would wait for ever
    throw;
  }
}

ThreadCrew::~ThreadCrew() {
  stop();
}

void ThreadCrew::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  given_changed_.notify_all();
  threads_.clear();  // joins
}

void ThreadCrew::give(std::size_t task, std::string bytes) {
  {
    const std::lock_guard lock(mutex_);
    given_.push_back({task, std::move(bytes)});
  }
  ++tasks_;
  given_changed_.notify_one();
}

std::optional<TaskResult> ThreadCrew::take() {
  const std::lock_guard lock(mutex_);
  if (finished_.empty()) {
    return std::nullopt;
  }
  TaskResult result = std::move(finished_.front());
  finished_.pop_front();
  --tasks_;
  return result;
}

void ThreadCrew::forget() {
  const std::lock_guard lock(mutex_);
  tasks_ -= given_.size();
  given_.clear();
}

void ThreadCrew::wait(std::chrono::microseconds longest) {
  std::unique_lock lock(mutex_);
  finished_changed_.wait_for(lock, longest, [&] { return !finished_.empty(); });
}

void ThreadCrew::work_on() {
  std::unique_lock lock(mutex_);
  while (true) {
    given_changed_.wait(lock, [&] { return stop_ || !given_.empty(); });
    if (stop_) {
      return;
    }
    const Given given = std::move(given_.front());
    given_.pop_front();
    lock.unlock();
    TaskResult result = do_task(given);
    lock.lock();
    finished_.push_back(std::move(result));
    finished_changed_.notify_one();
  }
}

TaskResult ThreadCrew::do_task(const Given& given) const {
  using Outcome = TaskResult::Outcome;
  TaskResult result;
  result.task = given.task;
  const auto start = std::chrono::steady_clock::now();
  try {
    result.bytes = work_(given.bytes);
  } catch (const InputError& error) {
    result.outcome = Outcome::bad_input;
    result.file = error.file();
    result.bytes = error.problem();
  } catch (const Error& error) {
    result.outcome = Outcome::failed;
    result.file = error.file();
    result.bytes = error.problem();
  } catch (const std::bad_alloc&) {
    result.outcome = Outcome::failed;
    result.bytes = "not enough memory";
  } catch (const std::exception& error) {
    result.outcome = Outcome::failed;
    result.bytes = error.what();
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  result.seconds = spent.count();
  return result;
}

void rest_beside(ThreadCrew* crew, std::chrono::microseconds pause) {
  if (pause.count() == 0) {
    std::this_thread::yield();
  } else if (crew != nullptr) {
    crew->wait(pause);
  } else {
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace spincat
