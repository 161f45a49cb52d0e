// Starts threads, or says that there are none to be had.
#pragma once

#include <system_error>
#include <thread>
#include <utility>

#include "spincat/error.h"

namespace spincat {

// A thread that runs `work`. Throws RunError where the system gives none: the user's limit of processes is reached, or
// that of memory.
template <class Work>
std::jthread start_thread(Work&& work) {
  try {
    return std::jthread(std::forward<Work>(work));
  } catch (const std::system_error& error) {
    throw RunError("a thread cannot be started: " + error.code().message());
  }
}

}  // namespace spincat
