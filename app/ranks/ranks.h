// The other processes of this run, where a launcher (mpirun, srun) has started several.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "spincat/parallel/communicator.h"
#include "spincat/parallel/task_farm.h"

namespace spincat::app {

// What the environment says about how this process was started.
struct Launch {
  int processes = 1;             // of this run
  int number = 0;                // of this process
  int on_host = 0;               // processes of this run on this host; 0 where the launcher does not tell
  std::string launcher;          // "mpirun (Open MPI)"; empty when there is none
  std::vector<std::string> mpi;  // plug-ins to try, the likeliest first
  bool outlives_ranks = false;   // whether the launcher lets the others go on when one is lost
};

Launch read_launch();

// The MPIs for which there is a plug-in: "openmpi", "mpich", "other".
std::vector<std::string> mpi_plugins();

// The usual one; with SPINCAT_SHARE=always rank 0 does nothing that another rank can do, broadcasts tables however
// small they are, and tells what the others did: so small runs test what large ones do.
FarmPolicy farm_policy();

// Joins the ranks of this run: loads MPI where a launcher has started several processes, and only then. The end of
// the communicator ends MPI. Throws RunError when there is no MPI for this launcher, or when MPI sees another number of
// processes than were started: each of them would do the whole work.
std::unique_ptr<Communicator> join_ranks(const Launch& launch);

}  // namespace spincat::app
