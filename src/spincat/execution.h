// How work is done: by whom, how strictly, and who is told about it. The results that it gives do not depend on it.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "spincat/io/read_limits.h"

#pragma GCC visibility push(default)
namespace spincat {

class TaskFarm;  // the command's threads and ranks; users have no way to make one

// Called now and then with what is being done ("describing objects"), how many units are done and how many there are;
// within a stage `done` never falls, and reaches `total` in the end.
// Calls come from any thread, but never two at a time. An exception thrown from it ends the work cleanly and reaches
// the caller: that is how a run is interrupted. May be empty.
using Progress = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

// Who encodes the spin images that several ranks make.
enum class WorkSplit {
  encode_remotely,  // whoever makes images encodes them, too, and returns sums
  return_images,    // the paper's way: rank 0 prepares, images are returned, rank 0 encodes
};

struct Execution {
  int threads = 1;           // of this process, 1 or more
  TaskFarm* farm = nullptr;  // whose threads and ranks do the work instead, where there is one; must outlive the call
  WorkSplit split = WorkSplit::encode_remotely;  // of the spin images of one object
  bool strict = false;  // the first object that cannot be read is an InputError, instead of being left out and listed
  ReadLimits limits = {};  // while reading files that no Dataset lists; a Dataset has its own
  Progress progress = {};
};

}  // namespace spincat
#pragma GCC visibility pop
