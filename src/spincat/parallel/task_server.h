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
  abandoned   // the process that started this one has gone, or rank 0: seen on its host, else after 150 deadlines
};

// Does the tasks that rank 0 hands out. `thread_count` says how many threads to use when the user asked for so many
// (0: for what is there). `keep_going` is called now and then; what it throws ends the service and arrives here.
ServiceEnd serve(Communicator& ranks, const WorkFactory& factory, const std::function<int(int requested)>& thread_count,
                 const std::function<void()>& keep_going);

}  // namespace spincat
