// Rank 0's signs of life.
#pragma once

#include <stop_token>
#include <thread>

#include "spincat/parallel/communicator.h"

namespace spincat {

// Has a thread tell all other ranks twice a second that this one is there, until this object goes: rank 0 may be busy
// for minutes with what no other rank takes part in.
class Heartbeat {
 public:
  explicit Heartbeat(Communicator& ranks);

 private:
  void beat_on(const std::stop_token& stop);
  void beat();

  Communicator& ranks_;
  std::jthread thread_;  // last, so that it ends first
};

}  // namespace spincat
