// Where the threads of this run's processes may run, and how many each should have.
#pragma once

#include <string>
#include <vector>

namespace spincat {

class Communicator;

struct Placement {
  int allowed = 1;              // processors that this process may run on
  int all = 1;                  // processors of its machine
  int ranks_on_host = 1;        // ranks of this machine, this one included
  int ranks_on_processors = 1;  // those of them that may run on the very processors that this one may, it included
};

Placement placement_of(const Communicator& ranks);

// The number of threads to use when the user asks for `requested`: for 0, an even part of the processors that this
// process may run on.
int thread_count(int requested, const Placement& placement);

// What ruins parallel runs: threads that share a processor without need. One line each. Every rank of this machine is
// taken to have so many threads.
std::vector<std::string> placement_warnings(int threads, const Placement& placement);

}  // namespace spincat
