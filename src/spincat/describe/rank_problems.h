// Works whose results begin with a problem in words, empty where there is none.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "spincat/error.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/task.h"

namespace spincat {

inline bool has_no_problem(std::string_view result) {
  return Unpacker(result).get_text().empty();
}

// On rank 0 a problem is a result, but none for the journal: the next run may have the file, or the memory. On another
// rank it may be the host's own: thrown, it makes rank 0 look for itself.
inline Work throwing_problems(Work work) {
  return [work = std::move(work)](std::string_view task) {
    std::string result = work(task);
    if (!has_no_problem(result)) {
      throw InputError(std::string(Unpacker(result).get_text()));
    }
    return result;
  };
}

}  // namespace spincat
