// Calls of the system, taken over in this program: they are noted, or fail on demand, and are then passed on.
#pragma once

#include <cerrno>
#include <string>
#include <vector>

namespace spincat::test {

struct Watch {
  bool on = false;
  int fails_at = -1;  // number of the call that fails
  int error = EIO;
  std::vector<std::string> calls;
};

Watch& watch();

}  // namespace spincat::test
