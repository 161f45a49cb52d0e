// Threads within one process.
#pragma once

#include <cstddef>
#include <functional>

namespace spincat {

// The number of threads to use when the user asks for `requested`: all processors this process may run on for 0.
int thread_count(int requested);

// Calls body(0), ..., body(count - 1), each once, on `threads` threads, in any order. When calls throw, no new ones are
// started, and the exception of the smallest index that threw is rethrown here.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace spincat
