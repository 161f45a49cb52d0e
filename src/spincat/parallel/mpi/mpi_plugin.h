// What the MPI plug-in offers to the command, which is not linked to any MPI and loads it where a launcher
// has started several ranks.
#pragma once

#include "spincat/parallel/communicator.h"

namespace spincat {

// Changes with Communicator: a plug-in of another version is not used.
inline constexpr int kMpiPluginVersion = 6;
inline constexpr const char* kMpiPluginVersionName = "spincat_mpi_plugin_version";
inline constexpr const char* kJoinRanksName = "spincat_join_ranks";

// Starts MPI (once a process) and returns this process's communicator, whose end ends MPI; null when MPI cannot start.
// Only the thread that calls this may end it.
using JoinRanks = Communicator* (*)();

}  // namespace spincat
