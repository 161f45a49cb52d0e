#include "spincat/parallel/farm_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace spincat {
namespace {

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// Percent of the time that a rank's threads worked.
double busy_percent(const FarmReport::Rank& rank, double seconds) {
  const double all = seconds * rank.threads;
  return all > 0.0 ? std::min(100.0, 100.0 * rank.busy_seconds / all) : 0.0;
}

// How busy each rank was; the range where there are many.
std::string busy_text(const FarmReport& report) {
  constexpr std::size_t kMostRanks = 16;
  std::vector<double> percents;
  std::string each;
  for (const FarmReport::Rank& rank : report.ranks) {
    percents.push_back(busy_percent(rank, report.seconds));
    each += fmt::format(" {}", rank.lost ? "lost" : fmt::format("{:.0f}%", percents.back()));
  }
  if (percents.size() <= kMostRanks) {
    return "busy" + each;
  }
  const auto [least, most] = std::ranges::minmax_element(percents);
  const auto lost = std::ranges::count(report.ranks, true, &FarmReport::Rank::lost);
  return fmt::format("busy {:.0f}% to {:.0f}%, {} lost", *least, *most, lost);
}

}  // namespace

std::string FarmReport::text() const {
  std::set<std::string> hosts;
  std::size_t threads = 0;
  for (const Rank& rank : ranks) {
    if (!rank.host.empty()) {  // a lost rank may never have said where it is
      hosts.insert(rank.host);
    }
    threads += static_cast<std::size_t>(rank.threads);
  }
  std::string line = fmt::format("{} on {}, {}: {}", counted(ranks.size(), "rank"), counted(hosts.size(), "host"),
                                 counted(threads, "thread"), busy_text(*this));
  if (resumed > 0) {
    line += fmt::format("; {} from the journal", counted(resumed, "task"));
  }
  line += handed_out_again > 0 ? fmt::format("; {} handed out again", counted(handed_out_again, "task"))
                               : "; nothing handed out again";
  for (const auto& [kind, tasks] : remote_tasks) {
    line += fmt::format("; {} {} elsewhere", tasks, kind);
  }
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    if (!ranks[r].refusal.empty()) {
      return line + fmt::format("; rank {} could not take part: {}", r, ranks[r].refusal);
    }
  }
  return line;
}

}  // namespace spincat
