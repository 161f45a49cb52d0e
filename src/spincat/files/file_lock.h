// Locks on open files, as other processes see them.
#pragma once

#include <sys/file.h>

#include <cerrno>

namespace spincat {

// flock() through interruptions; `how` is LOCK_EX and the like. False and errno where it fails: EWOULDBLOCK where
// another holds the lock and LOCK_NB was asked for.
inline bool lock(int descriptor, int how) {
  int result = 0;
  do {
    result = ::flock(descriptor, how);
  } while (result != 0 && errno == EINTR);
  return result == 0;
}

}  // namespace spincat
