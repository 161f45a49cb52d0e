// What other ranks can do for rank 0.
#pragma once

#include "spincat/parallel/task.h"

namespace spincat {

// Makes any kind of work that is shared out: for serve() (parallel/task_server.h).
WorkFactory rank_work();

}  // namespace spincat
