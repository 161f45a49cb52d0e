#include "spincat/parallel/placement.h"

#include <fmt/format.h>

#include <algorithm>

#include "spincat/parallel/communicator.h"
#include "spincat/parallel/for_each.h"

namespace spincat {
namespace {

std::string counted(int count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

Placement placement_of(const Communicator& ranks) {
  return {allowed_processors(), all_processors(), ranks.ranks_on_host(), ranks.ranks_on_processors()};
}

int thread_count(int requested, const Placement& placement) {
  return requested > 0 ? requested : std::max(1, placement.allowed / std::max(1, placement.ranks_on_processors));
}

std::vector<std::string> placement_warnings(int threads, const Placement& placement) {
  const auto& [allowed, all, ranks_on_host, ranks_on_processors] = placement;
  std::vector<std::string> warnings;
  if (threads * ranks_on_processors > allowed && allowed < all) {
    const std::string whose =
        ranks_on_processors == 1 ? fmt::format("{} share", counted(threads, "thread"))
                                 : fmt::format("{} ranks of {} share", ranks_on_processors, counted(threads, "thread"));
    warnings.push_back(
        fmt::format("{} the {} that the launcher has bound {} to (mpirun --bind-to none, "
                    "srun --cpus-per-task)",
                    whose, counted(allowed, "processor"), ranks_on_processors == 1 ? "this rank" : "them"));
  } else if (threads * ranks_on_host > all) {
    warnings.push_back(fmt::format("{} ranks of {} share the {} of this host", ranks_on_host,
                                   counted(threads, "thread"), counted(all, "processor")));
  }
  return warnings;
}

}  // namespace spincat
