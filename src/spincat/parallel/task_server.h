// What every rank but 0 does: work for the farm of rank 0.
#pragma once

#include <functional>

#include "spincat/parallel/communicator.h"
#include "spincat/parallel/task.h"

namespace spincat {

// Why a rank has nothing more to do.
enum class ServiceEnd {
  dismissed,  // rank 0 said so, when all ranks were done
  cut_off,    // a message to or from rank 0 failed
  abandoned   // rank 0 or the process that started this one has gone
};

struct ServiceRules {
  // How many threads to use when the user asked for so many (0: for what is there).
  std::function<int(int requested)> thread_count;
  // Called now and then. What it throws ends the work, and arrives at the caller when all ranks are done.
  std::function<void()> keep_going;
  // Whether to leave when rank 0, on another host, says nothing for 150 deadlines. Where the launcher ends all ranks
  // when one is lost this is never needed, and would end them for a rank that is only cut off.
  bool leaves_silent_rank0 = false;
};

// Does the tasks that rank 0 hands out.
ServiceEnd serve(Communicator& ranks, const WorkFactory& factory, const ServiceRules& rules);

}  // namespace spincat
