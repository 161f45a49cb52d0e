// What every rank but 0 does: work for the farm of rank 0.
#pragma once

#include <functional>

#include "spincat/parallel/communicator.h"
#include "spincat/parallel/task.h"

namespace spincat {

// Does the tasks that rank 0 hands out until it says that this was all, or until the process that started this one is
// gone. `thread_count` says how many threads to use when the user asked for so many (0: for what is there).
// `keep_going` is called now and then; what it throws ends the service and arrives here.
void serve(Communicator& ranks, const WorkFactory& factory, const std::function<int(int requested)>& thread_count,
           const std::function<void()>& keep_going);

}  // namespace spincat
