// A process to which the system gives no further thread.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

#include "spincat/error.h"

namespace spincat::test {

// Calls `work` where no thread can be started, and ends this process: with 7 when it throws RunError as it should. For
// EXPECT_EXIT. Root may start any number and becomes nobody first.
template <class Work>
[[noreturn]] void end_without_threads(const Work& work) {
  constexpr uid_t kNobody = 65534;
  const rlimit none = {0, 0};
  if ((::geteuid() == 0 && ::setuid(kNobody) != 0) || ::setrlimit(RLIMIT_NPROC, &none) != 0) {
    std::_Exit(1);
  }
  ::alarm(20);  // a wait for ever is a failure, too
  try {
    work();
  } catch (const RunError&) {
    std::_Exit(7);
  }
  std::_Exit(2);
}

}  // namespace spincat::test
