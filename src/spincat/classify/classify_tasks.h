// Naming many files on all threads and ranks of a farm (classify.h).
#pragma once

#include <string_view>

#include "spincat/parallel/task.h"

namespace spincat {

// The name of this kind of work, as ranks tell each other.
inline constexpr const char* kClassifyTasks = "names of objects";

// The work of classify_files, for other ranks.
Work make_classify_work(std::string_view context);

}  // namespace spincat
