// Keeps MPI's start and end, which wait for every rank, from waiting for one that was lost.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "app/ranks/ranks.h"

namespace spincat::app {

// Has a thread look fifty times a second at first, ten times later, until this object goes.
class MpiWatch {
 public:
  explicit MpiWatch(std::function<void()> look);
  ~MpiWatch();
  MpiWatch(const MpiWatch&) = delete;
  MpiWatch& operator=(const MpiWatch&) = delete;

 private:
  void look_on();

  const std::function<void()> look_;
  std::mutex mutex_;
  std::condition_variable over_changed_;
  bool over_ = false;  // guarded by mutex_
  std::jthread thread_;
};

// What is known of the ranks of this host, from their start on.
class HostRanks;
std::shared_ptr<HostRanks> ranks_of_host();

// While MPI starts: ends this process with a line that says so when a rank beside it has gone, was never seen or stays
// stopped, or after thirty deadlines for silence; kills the ranks that are stopped. Nothing is lost by then: the
// journal has what an earlier run finished.
std::unique_ptr<MpiWatch> watch_start(const Launch& launch, std::shared_ptr<HostRanks> host);

struct MpiEnd {
  int exit_code = 0;  // of this process
  bool one_host = false;
};

// While MPI ends: kills ranks of this host that stay stopped, and ends this process with its exit code when a rank
// beside it has long gone. After fifteen deadlines rank 0 kills those of its host that are left, and ends; so do ranks
// on several hosts. Whatever the command had to write is complete by then.
std::unique_ptr<MpiWatch> watch_end(const Launch& launch, std::shared_ptr<HostRanks> host, const MpiEnd& end);

// For rank 0, when MPI has ended: waits for the other ranks of this host to go, at most two deadlines, and kills those
// that stay stopped, and then those that stay: nobody else would, and the launcher would wait for them for ever.
void leave_last(const Launch& launch, HostRanks& host);

}  // namespace spincat::app
