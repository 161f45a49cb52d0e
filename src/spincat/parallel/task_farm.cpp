#include "spincat/parallel/task_farm.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "spincat/parallel/farm_messages.h"
#include "spincat/parallel/farm_ranks.h"
#include "spincat/parallel/heartbeat.h"

namespace spincat {
namespace {

using Clock = TaskFarm::Clock;

constexpr std::chrono::milliseconds kGreetingPatience(2000);

}  // namespace

TaskFarm::TaskFarm(Communicator& ranks, const FarmPolicy& policy)
    : ranks_(ranks), policy_(policy), others_(static_cast<std::size_t>(ranks.size()) - 1) {
  say_to_all(farm::kHello, to_send(pack(farm::own_greeting())));
  try {
    heartbeat_ = others_.empty() ? nullptr : std::make_unique<Heartbeat>(ranks_);
  } catch (...) {  // no thread can be made
    dismiss();
    throw;
  }
}

TaskFarm::~TaskFarm() {
  dismiss();
}

void TaskFarm::use_threads(int here, int requested) {
  threads_ = here;
  requested_threads_ = requested;
}

void TaskFarm::use_journal(Journal* journal, std::function<void(const RunError& problem)> tell_failure) {
  journal_ = journal;
  journal_is_full_ = false;
  tell_journal_failure_ = std::move(tell_failure);
}

int TaskFarm::threads_everywhere() const {
  int threads = threads_;
  for (const Rank& rank : others_) {
    threads += rank.threads > 0 ? rank.threads : threads_;
  }
  return threads;
}

void TaskFarm::broadcast(const std::string& kind, const Context& context) {
  if (others_.empty()) {
    return;
  }
  const SharedBytes start = start_of(++job_, kind, context);
  for (std::size_t r = 0; r < others_.size(); ++r) {
    ask(r, start);
  }
}

SharedBytes TaskFarm::start_of(std::uint32_t job, const std::string& kind, const Context& context) const {
  Packer packer;
  packer(farm::JobStart{job, requested_threads_, kind});
  if (context) {
    context(packer);
  }
  return to_send(packer.take());
}

FarmReport TaskFarm::report() {
  const auto start = Clock::now();
  const auto unknown = [](const Rank& rank) { return rank.greeting.host.empty() && !rank.lost; };
  while (std::ranges::any_of(others_, unknown) && Clock::now() - start < kGreetingPatience) {
    if (const std::optional<Message> message = ranks_.receive()) {
      greet_late(others_[static_cast<std::size_t>(message->from) - 1], *message);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  FarmReport report;
  report.ranks.push_back({farm::own_greeting().host, threads_, busy_here_, false, {}});
  for (const Rank& rank : others_) {
    report.ranks.push_back({rank.greeting.host, rank.threads, rank.busy_seconds, rank.lost, rank.refusal});
  }
  report.seconds = seconds_;
  report.handed_out_again = handed_out_again_;
  report.resumed = resumed_;
  report.remote_tasks = remote_tasks_;
  return report;
}

}  // namespace spincat
