#include "app/ranks/mpi_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/terminal/messages.h"
#include "spincat/parallel/process_state.h"
#include "spincat/parallel/task_farm.h"

namespace spincat::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenFirstLooks(20);  // a rank that goes unseen is missed only much later
constexpr std::chrono::milliseconds kBetweenLooks(100);
constexpr std::chrono::seconds kFirst(1);
constexpr std::chrono::milliseconds kBetweenLastLooks(2);
constexpr std::chrono::seconds kAllStarted(10);
constexpr std::chrono::milliseconds kStall(500);  // when we did not look for so long, we were stopped ourselves

// Processes that our parent has started and that run our program: the ranks of this host, as far as they have come.
// None where the kernel does not list children.
std::vector<std::int64_t> ranks_beside_us() {
  std::vector<std::int64_t> ranks;
  const pid_t parent = getppid();
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", parent));
  for (std::int64_t child = 0; children >> child;) {
    if (runs_our_program(child)) {
      ranks.push_back(child);
    }
  }
  return ranks;
}

// Only its children are all ranks of this host; what it starts may be a script that starts us.
bool is_started_by_launcher() {
  std::ifstream file(fmt::format("/proc/{}/comm", getppid()));
  std::string name;
  std::getline(file, name);
  return std::ranges::any_of(std::array{"mpirun", "mpiexec", "orte", "prte", "hydra_pmi"},
                             [&](std::string_view launcher) { return name.starts_with(launcher); });
}

}  // namespace

// What becomes of the ranks of this host. Times are in deadlines for silence: others get as long to tell more of the
// reason, to end as they should, or to be continued.
class HostRanks {
 public:
  void look() {
    const auto now = Clock::now();
    if (now - last_look_ > kStall) {
      forget(now - last_look_);
    }
    last_look_ = now;
    for (const std::int64_t rank : ranks_beside_us()) {
      seen_.try_emplace(rank, Seen{now, now});
    }
    for (auto& [rank, seen] : seen_) {
      seen.last_there = is_there(rank) ? now : seen.last_there;
      seen.last_running = is_stopped(rank) ? seen.last_running : now;
    }
  }

  // What was before does not count any more; who was seen does.
  void begin_again() {
    start_ = Clock::now();
    for (auto& [rank, seen] : seen_) {
      seen = {start_, start_};
    }
  }

  void kill_stopped() const {
    for (const auto& [rank, seen] : seen_) {
      if (since(seen.last_running) > 0.25) {
        kill_if_ours(rank);
      }
    }
  }

  void kill_others() const {
    for (const auto& [rank, seen] : seen_) {
      if (rank != getpid()) {
        kill_if_ours(rank);
      }
    }
  }

  bool others_are_there() const {
    return std::ranges::any_of(seen_, [](const auto& rank) { return rank.first != getpid() && is_there(rank.first); });
  }

  // Whether one of so many was lost before anybody saw it. The launcher starts all at once, but a busy host may take
  // its time.
  bool lacks(int ranks) const {
    return has_launcher_ && Clock::now() - start_ > kAllStarted && static_cast<std::size_t>(ranks) > seen_.size();
  }
  double gone_for() const { return longest_since(&Seen::last_there); }
  double stopped_for() const { return longest_since(&Seen::last_running); }
  double watched_for() const { return since(start_); }

 private:
  struct Seen {
    Clock::time_point last_there;
    Clock::time_point last_running;
  };

  static void kill_if_ours(std::int64_t rank) {
    if (runs_our_program(rank)) {
      ::kill(static_cast<pid_t>(rank), SIGKILL);
    }
  }

  // As if this time had not been.
  void forget(Clock::duration time) {
    start_ += time;
    for (auto& [rank, seen] : seen_) {
      seen.last_there += time;
      seen.last_running += time;
    }
  }

  static double since(Clock::time_point then) { return (Clock::now() - then) / silence_deadline(); }

  double longest_since(Clock::time_point Seen::*what) const {
    double longest = 0.0;
    for (const auto& [rank, seen] : seen_) {
      longest = std::max(longest, since(seen.*what));
    }
    return longest;
  }

  const bool has_launcher_ = is_started_by_launcher();
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_look_ = start_;
  std::map<std::int64_t, Seen> seen_;
};

namespace {

// Not exit(): what it would call belongs to a thread that hangs in MPI.
[[noreturn]] void give_up_start(const Launch& launch, const HostRanks& host, const char* reason) {
  if (launch.number == 0) {
    message(fmt::format("{} while MPI started; run the same command again to continue", reason));
  }
  host.kill_stopped();  // the launcher would wait for them for ever
  std::_Exit(1);
}

}  // namespace

std::shared_ptr<HostRanks> ranks_of_host() {
  return std::make_shared<HostRanks>();
}

MpiWatch::MpiWatch(std::function<void()> look) : look_(std::move(look)), thread_([this] { look_on(); }) {}

MpiWatch::~MpiWatch() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  over_changed_.notify_all();
}

void MpiWatch::look_on() {
  std::unique_lock lock(mutex_);
  const auto start = Clock::now();
  do {
    look_();
  } while (!over_changed_.wait_for(lock, Clock::now() - start < kFirst ? kBetweenFirstLooks : kBetweenLooks,
                                   [&] { return over_; }));
}

std::unique_ptr<MpiWatch> watch_start(const Launch& launch, std::shared_ptr<HostRanks> host) {
  if (launch.processes < 2) {
    return nullptr;
  }
  return std::make_unique<MpiWatch>([launch, host = std::move(host)] {
    host->look();
    // Rank 0 first: a launcher may end all others with the first that ends, and it has something to say.
    const double later = launch.number == 0 ? 0.0 : 0.5;
    const bool is_missed = host->watched_for() > 2.0 + later && host->lacks(launch.on_host);
    if (host->gone_for() > 1.0 + later || is_missed) {
      give_up_start(launch, *host, "a rank was lost");
    }
    if (host->stopped_for() > 5.0 + later || host->watched_for() > 30.0 + later) {
      give_up_start(launch, *host, "a rank did not answer");
    }
  });
}

std::unique_ptr<MpiWatch> watch_end(const Launch& launch, std::shared_ptr<HostRanks> host, const MpiEnd& end) {
  if (launch.processes < 2) {
    return nullptr;
  }
  host->begin_again();
  return std::make_unique<MpiWatch>([host = std::move(host), end, is_first = launch.number == 0] {
    host->look();
    host->kill_stopped();
    const bool in_vain = host->watched_for() > 15.0 && (is_first || !end.one_host);
    if (in_vain && is_first) {
      host->kill_others();  // they no longer hear us
    }
    if (in_vain || host->gone_for() > 2.0) {
      std::_Exit(end.exit_code);
    }
  });
}

void leave_last(const Launch& launch, HostRanks& host) {
  if (launch.processes < 2 || launch.number != 0) {
    return;
  }
  host.begin_again();
  host.look();
  while (host.others_are_there() && host.watched_for() < 3.0) {
    host.kill_stopped();
    if (host.watched_for() > 2.0) {
      host.kill_others();  // they no longer hear us
    }
    std::this_thread::sleep_for(kBetweenLastLooks);
    host.look();
  }
}

}  // namespace spincat::app
