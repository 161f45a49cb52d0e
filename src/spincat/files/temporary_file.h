// The files that results are written to before they get their names, and what killed runs leave of them.
#pragma once

#include <filesystem>

namespace spincat {

// Creates a file in `folder` that nobody else has, .spincat-HOST-PID-N.tmp, with the mode that the process gives its
// files, and locks it (flock) for as long as its descriptor or a duplicate of that is open. `name` becomes its path.
// Returns the descriptor, or -1 and errno.
int create_temporary(const std::filesystem::path& folder, std::filesystem::path& name);

// Removes from `folder` the temporary files of this host that no living process holds a lock on. Those of other hosts
// stay: a lock may not be seen across a network file system. A folder is looked through once in the life of the
// process; what cannot be read, locked or removed is passed over.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace spincat
