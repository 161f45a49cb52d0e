// Ranks that are threads of one process: everything about the farm that needs no MPI.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "spincat/parallel/communicator.h"

namespace spincat::test {

// The wires between the ranks.
struct Wires {
  explicit Wires(int ranks)
      : inbox(static_cast<std::size_t>(ranks)),
        mute(inbox.size(), false),
        cut(inbox.size(), false),
        waiting(inbox.size(), 0) {}

  std::mutex mutex;
  std::vector<std::deque<Message>> inbox;
  std::vector<bool> mute;            // what these ranks say is lost, as if they were dead
  std::vector<bool> cut;             // whose wire to and from rank 0 is known to be broken
  std::vector<std::size_t> waiting;  // as if so many bytes to these ranks were on their way besides

  void silence(int rank, bool silent = true) {
    const std::lock_guard lock(mutex);
    mute[static_cast<std::size_t>(rank)] = silent;
  }

  void slow_down(int rank, std::size_t bytes) {
    const std::lock_guard lock(mutex);
    waiting[static_cast<std::size_t>(rank)] = bytes;
  }

  // Nobody has taken.
  std::size_t bytes_to(int rank) const {
    std::size_t bytes = waiting[static_cast<std::size_t>(rank)];
    for (const Message& message : inbox[static_cast<std::size_t>(rank)]) {
      bytes += message.bytes.size();
    }
    return bytes;
  }

  void cut_off(int rank) {
    const std::lock_guard lock(mutex);
    cut[static_cast<std::size_t>(rank)] = true;
  }
};

class ThreadCommunicator final : public Communicator {
 public:
  ThreadCommunicator(std::shared_ptr<Wires> wires, int rank) : wires_(std::move(wires)), rank_(rank) {}

  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(wires_->inbox.size()); }
  int ranks_on_host() const override { return size(); }
  int ranks_on_processors() const override { return size(); }
  std::string implementation() const override { return "threads"; }

  void send(int to, int tag, SharedBytes bytes) override {
    const std::lock_guard lock(wires_->mutex);
    if (!wires_->mute[static_cast<std::size_t>(rank_)] && !is_cut(to)) {
      wires_->inbox[static_cast<std::size_t>(to)].push_back({rank_, tag, *bytes});
    }
  }

  std::optional<Message> receive() override {
    const std::lock_guard lock(wires_->mutex);
    auto& inbox = wires_->inbox[static_cast<std::size_t>(rank_)];
    if (inbox.empty()) {
      return std::nullopt;
    }
    Message message = std::move(inbox.front());
    inbox.pop_front();
    heard_[message.from] = Clock::now();
    return message;
  }

  bool has_sent(int) override { return true; }

  std::size_t bytes_waiting(int to) const override {
    const std::lock_guard lock(wires_->mutex);
    return wires_->bytes_to(to);
  }

  Clock::time_point heard(int from) const override {
    const std::lock_guard lock(wires_->mutex);
    const auto found = heard_.find(from);
    return found != heard_.end() ? found->second : start_;
  }

  std::size_t under_way() const override { return 0; }
  void give_up(int) override {}
  bool is_cut_off(int rank) const override {
    const std::lock_guard lock(wires_->mutex);
    return is_cut(rank);
  }

 private:
  bool is_cut(int other) const { return wires_->cut[static_cast<std::size_t>(std::max(rank_, other))]; }

  std::shared_ptr<Wires> wires_;
  int rank_;
  const Clock::time_point start_ = Clock::now();
  std::map<int, Clock::time_point> heard_;
};

}  // namespace spincat::test
