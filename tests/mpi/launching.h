// Running the whole command under the launchers of MPI.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include "support/temp_dir.h"

namespace spincat::test {

namespace fs = std::filesystem;

inline std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Other ranks do all that they can: what tests train is else too little to be shared out.
inline constexpr const char* kShareAlways = "SPINCAT_SHARE=always";

// A make of MPI: its plug-in and its launcher.
struct Mpi {
  std::string name;      // of the plug-in
  std::string launcher;  // with what every test needs: more ranks than processors, ranks not bound to one of them
  std::string recovery;  // option with which a run outlives a lost rank; empty where there is none
};

inline std::ostream& operator<<(std::ostream& stream, const Mpi& mpi) {
  return stream << mpi.name;
}

inline const Mpi kOpenMpi{
    "openmpi",
    "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun.openmpi --oversubscribe "
    "--bind-to none",
    "--enable-recovery"};
inline const Mpi kMpich{"mpich", "mpirun.mpich", ""};

// Why nothing can be run under this MPI here; empty when it can.
inline std::string reason_to_skip(const Mpi& mpi) {
  if (!fs::exists(fs::path(SPINCAT_COMMAND).parent_path() / "mpi" / ("spincat_mpi_" + mpi.name + ".so"))) {
    return "the build has no plug-in for " + mpi.name;
  }
  if (std::system(("command -v mpirun." + mpi.name + " >/dev/null").c_str()) != 0) {
    return "mpirun." + mpi.name + " is not installed";
  }
  return {};
}

struct RunResult {
  int code = -1;
  std::string out;
  std::string err;
};

class Launching : public testing::Test {
 protected:
  // Nothing reads the launcher's output through a pipe: ranks that outlive it would keep that open.
  RunResult shell(const std::string& command, const std::string& environment = "") {
    const fs::path out = dir_.path() / ".out";
    const fs::path err = dir_.path() / ".err";
    const std::string line = fmt::format("cd '{}' && {} timeout -k 1 100 {} >'{}' 2>'{}' </dev/null",
                                         dir_.path().string(), environment, command, out.string(), err.string());
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out), contents(err)};
  }

  RunResult alone(const std::string& arguments) { return shell(fmt::format("'{}' {}", SPINCAT_COMMAND, arguments)); }

  RunResult launch(const Mpi& mpi, int ranks, const std::string& arguments, const std::string& environment = "") {
    return shell(fmt::format("{} -n {} '{}' {}", mpi.launcher, ranks, SPINCAT_COMMAND, arguments), environment);
  }

  std::string bytes(const std::string& file) const { return contents(dir_.path() / file); }

  // A bumpy sphere of n x 2n vertices as an OFF file.
  void make_scan(const std::string& file, int n) {
    std::string off = fmt::format("OFF\n{} {} 0\n", n * 2 * n, (n - 1) * 2 * n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < 2 * n; ++j) {
        const double theta = (i + 0.5) * M_PI / n;
        const double phi = j * M_PI / n;
        const double r = 1.0 + 0.1 * std::sin(5 * theta) * std::cos(3 * phi);
        off += fmt::format("{} {} {}\n", r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi),
                           r * std::cos(theta));
      }
    }
    for (int i = 0; i + 1 < n; ++i) {
      for (int j = 0; j < 2 * n; ++j) {
        const int next = (j + 1) % (2 * n);
        off += fmt::format("4 {} {} {} {}\n", i * 2 * n + j, (i + 1) * 2 * n + j, (i + 1) * 2 * n + next,
                           i * 2 * n + next);
      }
    }
    dir_.write(file, off);
  }

  // Three categories of boxes of different proportions.
  void make_dataset(int objects_each) {
    const auto box = [](double x, double y, double z) {
      std::string off = "OFF\n8 6 0\n";
      for (int i = 0; i < 8; ++i) {
        off += fmt::format("{} {} {}\n", (i & 1) != 0 ? x : 0.0, (i & 2) != 0 ? y : 0.0, (i & 4) != 0 ? z : 0.0);
      }
      return off + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
    };
    for (int i = 0; i < objects_each; ++i) {
      const double s = 1.0 + 0.05 * i;
      dir_.write(fmt::format("boxes/cube/{:02}.off", i), box(s, 1.0, 1.0));
      dir_.write(fmt::format("boxes/plate/{:02}.off", i), box(s, 1.0, 0.2));
      dir_.write(fmt::format("boxes/stick/{:02}.off", i), box(0.2 * s, 0.2, 1.0));
    }
  }

  TempDir dir_;
};

}  // namespace spincat::test
