// Threads beside the loop, or one line that says which of them there is none for.
#pragma once

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "spincat/error.h"
#include "spincat/files/system_error_text.h"

namespace spincat::app {

// Throws RunError where the system has no more threads; `what` it would have been for.
template <class Work>
std::jthread start_thread(const char* what, Work&& work) {
  try {
    return std::jthread(std::forward<Work>(work));
  } catch (const std::system_error& error) {
    throw RunError(fmt::format("there is no thread for {}: {}", what, system_error_text(error.code().value())));
  }
}

}  // namespace spincat::app
