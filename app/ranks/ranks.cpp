#include "app/ranks/ranks.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "spincat/error.h"
#include "spincat/parallel/mpi/mpi_plugin.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

// A launcher and the variables by which it tells a process about its run.
struct Launcher {
  const char* name;
  const char* processes;
  const char* number;
  std::vector<std::string> mpi;
};

// Open MPI's variables first: its processes may have Slurm's, too.
const std::vector<Launcher>& launchers() {
  static const std::vector<Launcher> known = {
      {"mpirun (Open MPI)", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", {"openmpi", "other"}},
      {"mpirun (MPICH or another with Hydra)", "PMI_SIZE", "PMI_RANK", {"mpich", "other"}},
      {"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID", {"openmpi", "mpich", "other"}}};
  return known;
}

int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : -1;
}

bool is_set(const char* variable) {
  return std::getenv(variable) != nullptr;
}

// As Open MPI reads it: a number, or a word such as "true" or "enabled".
bool is_on(const char* variable) {
  const char* text = std::getenv(variable);
  return text != nullptr &&
         (std::atoi(text) != 0 || std::string_view("tTyYeE").find(text[0]) != std::string_view::npos);
}

// Beside the program in a build, in lib/spincat beside bin where it is installed.
std::vector<fs::path> plugin_folders() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {here / "mpi", here.parent_path() / SPINCAT_PLUGIN_FOLDER};
}

fs::path plugin_file(const fs::path& folder, const std::string& mpi) {
  return folder / ("spincat_mpi_" + mpi + ".so");
}

// The plug-in's function, or nothing and in `tried` why not.
JoinRanks load(const std::string& mpi, std::vector<std::string>& tried) {
  for (const fs::path& folder : plugin_folders()) {
    const fs::path file = plugin_file(folder, mpi);
    std::error_code error;
    if (!fs::exists(file, error)) {
      continue;
    }
    // Global: an MPI loads parts of its own that look for its symbols.
    void* plugin = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (plugin == nullptr) {
      tried.emplace_back(dlerror());
      continue;
    }
    using Version = int (*)();
    const auto version = reinterpret_cast<Version>(dlsym(plugin, kMpiPluginVersionName));
    if (version != nullptr && version() == kMpiPluginVersion) {
      return reinterpret_cast<JoinRanks>(dlsym(plugin, kJoinRanksName));
    }
    tried.push_back(fmt::format("{} belongs to another version", file.string()));
  }
  return nullptr;
}

std::string advice(const Launch& launch) {
  return launch.launcher == "srun" ? "; srun needs --mpi=pmix for Open MPI, --mpi=pmi2 for MPICH"
                                   : "; use the mpirun of an MPI that spincat was built with";
}

}  // namespace

std::vector<std::string> mpi_plugins() {
  std::vector<std::string> found;
  for (const char* mpi : {"openmpi", "mpich", "other"}) {
    for (const fs::path& folder : plugin_folders()) {
      std::error_code error;
      if (fs::exists(plugin_file(folder, mpi), error)) {
        found.emplace_back(mpi);
        break;
      }
    }
  }
  return found;
}

Launch read_launch() {
  Launch launch;
  for (const Launcher& launcher : launchers()) {
    const int processes = number_in(launcher.processes);
    if (processes < 1) {
      continue;
    }
    launch.processes = processes;
    launch.number = std::max(0, number_in(launcher.number));
    launch.on_host = std::max({0, number_in("OMPI_COMM_WORLD_LOCAL_SIZE"), number_in("MPI_LOCALNRANKS")});
    launch.launcher = launcher.name;
    launch.mpi = launcher.mpi;
    // Slurm may speak the language of either MPI, and only one of them answers.
    if (is_set("SLURM_STEP_NUM_TASKS") && !is_set("OMPI_COMM_WORLD_SIZE")) {
      launch.launcher = "srun";
      if (is_set("PMIX_RANK")) {
        launch.mpi = {"openmpi", "other"};
      } else if (is_set("PMI_FD") || is_set("PMI_SIZE")) {
        launch.mpi = {"mpich", "other"};
      } else {
        launch.mpi = {};  // srun --mpi=none
      }
    }
    // mpirun --enable-recovery
    launch.outlives_ranks = launch.launcher == "srun" || is_on("OMPI_MCA_orte_enable_recovery");
    break;
  }
  return launch;
}

FarmPolicy farm_policy() {
  const char* share = std::getenv("SPINCAT_SHARE");
  if (share == nullptr || std::string_view(share) != "always") {
    return {};
  }
  return {.most_ranks_to_work_beside = 0, .gain_of_broadcast = 0.0, .counts_remote_tasks = true};
}

std::unique_ptr<Communicator> join_ranks(const Launch& launch) {
  if (launch.processes < 2) {
    return std::make_unique<SerialCommunicator>();
  }
  std::vector<std::string> tried;
  for (const std::string& mpi : launch.mpi) {
    const JoinRanks join = load(mpi, tried);
    if (join == nullptr) {
      continue;
    }
    std::unique_ptr<Communicator> ranks(join());
    if (ranks == nullptr) {
      throw RunError("MPI cannot be started");
    }
    if (ranks->size() != launch.processes) {
      throw RunError(fmt::format("{} has started {} processes, but each of them is alone for {}{}", launch.launcher,
                                 launch.processes, ranks->implementation(), advice(launch)));
    }
    return ranks;
  }
  throw RunError(fmt::format("{} has started {} processes, but there is no MPI for it{}{}", launch.launcher,
                             launch.processes, tried.empty() ? "" : fmt::format(" ({})", fmt::join(tried, "; ")),
                             advice(launch)));
}

}  // namespace spincat::app
