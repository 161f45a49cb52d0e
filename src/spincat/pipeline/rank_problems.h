// Private to the library, not installed: problems that another rank meets.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "spincat/error.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/task.h"

namespace spincat {

// For works whose results begin with a problem in words, empty where there is none. On rank 0 that is a result; on
// another rank it may be the host's own (a file that is not there, no memory): thrown, it makes rank 0 look for itself.
inline Work throwing_problems(Work work) {
  return [work = std::move(work)](std::string_view task) {
    std::string result = work(task);
    if (const std::string_view problem = Unpacker(result).get_text(); !problem.empty()) {
      throw InputError(std::string(problem));
    }
    return result;
  };
}

}  // namespace spincat
