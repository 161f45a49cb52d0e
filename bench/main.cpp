// spincat_bench: how fast this build is on this machine, as JSON on standard output; experiments/bench makes a table of
// it.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

#include "sections.h"
#include "spincat/spin/kernel.h"

namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times spincat: spin images against PCL, the reference and the machine; one object by stage.");
  std::string scan;
  std::string objects;
  int rounds = 7;
  app.add_option("--scan", scan, "mesh of a real scan for the race (none: tori only)")->envname("SPINCAT_BENCH_SCAN");
  app.add_option("--objects", objects, "folder of objects to time by stage (none: left out)")
      ->envname("SPINCAT_BENCH_OBJECTS");
  app.add_option("--rounds", rounds, "how often each is timed");
  CLI11_PARSE(app, argc, argv);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // as the command does
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  try {
    nlohmann::ordered_json report;
    report["machine"] = processor();
    report["compiler"] = "g++ " __VERSION__;
    report["commit"] = SPINCAT_COMMIT;
    report["simd"] = spincat::spin_kernel().name;
    report["limits"] = spincat::bench::machine_limits(rounds);
    report["spin_images"] = spincat::bench::spin_race(scan, rounds);
    if (!objects.empty()) {
      report["milliseconds_per_object"] = spincat::bench::stage_times(objects, rounds);
    }
    std::cout << report.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "spincat_bench: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
