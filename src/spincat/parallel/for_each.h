// Threads within one process.
#pragma once

#include <cstddef>
#include <functional>

namespace spincat {

// The number of threads to use when the user asks for `requested`: all processors this process may run on for 0.
int thread_count(int requested);

// Processors this process may run on, and processors of this machine.
int allowed_processors();
int all_processors();

// Calls body(0), ..., body(count - 1), each once, on `threads` (1 or more) threads, in any order. When a call throws,
// those of larger indices are no longer started, and the exception of the smallest index that throws is rethrown here:
// the same one for any number of threads.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace spincat
