#include "spincat/parallel/task_queue.h"

namespace spincat {

TaskQueue::TaskQueue(std::size_t tasks, std::size_t window) : window_(window), done_(tasks, false) {}

std::optional<std::size_t> TaskQueue::next_for(int rank, Time now, Seconds patience) {
  std::optional<std::size_t> task;
  while (!taken_back_.empty() && !task) {
    if (!done_[taken_back_.front()]) {
      task = taken_back_.front();
    }
    taken_back_.pop_front();
  }
  while (next_ < done_.size() && done_[next_]) {
    ++next_;  // the journal had it
  }
  if (!task && next_ < done_.size() && next_ < delivered_ + window_) {
    task = next_++;
  }
  if (!task) {
    task = slow_one(rank, now, patience);
  }
  if (task) {
    Pending& pending = pending_[*task];
    pending.since = now;
    pending.ranks.push_back(rank);
  }
  return task;
}

std::optional<std::size_t> TaskQueue::slow_one(int rank, Time now, Seconds patience) const {
  for (const auto& [task, pending] : pending_) {
    if (pending.ranks.size() == 1 && pending.ranks[0] != rank && now - pending.since > patience) {
      return task;
    }
  }
  return std::nullopt;
}

bool TaskQueue::finish(std::size_t task) {
  pending_.erase(task);
  const bool first = !done_[task];
  done_[task] = true;
  return first;
}

std::size_t TaskQueue::take_back(int rank) {
  std::size_t count = 0;
  for (auto it = pending_.begin(); it != pending_.end();) {
    if (std::erase(it->second.ranks, rank) > 0 && it->second.ranks.empty()) {
      taken_back_.push_back(it->first);
      it = pending_.erase(it);
      ++count;
    } else {
      ++it;
    }
  }
  return count;
}

}  // namespace spincat
