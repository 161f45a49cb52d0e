#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "spincat/error.h"
#include "spincat/parallel/farm_messages.h"
#include "spincat/parallel/farm_ranks.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/pause.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/parallel/task_queue.h"
#include "spincat/parallel/thread_crew.h"

namespace spincat {
namespace {

constexpr int kHere = 0;                // rank 0, as an owner of tasks
constexpr std::size_t kTasksAhead = 2;  // a thread has this many tasks: one to do, one to go on with
// One of another rank has more of short ones: while rank 0 is busy with a result, nobody gives it another.
constexpr std::size_t kMostTasksAhead = 8;
constexpr double kSecondsAhead = 0.03;
constexpr std::chrono::milliseconds kBetweenTicks(50);

}  // namespace

// One job from its first task to its last.
class TaskFarm::Run {
 public:
  Run(TaskFarm& farm, const Job& job, const Tick& tick)
      : farm_(farm), job_(job), tick_(tick), number_(++farm.job_), queue_(job.tasks, window()) {
    if (job.in_journal && farm_.journal_ != nullptr) {
      journal_ = farm_.journal_;
      journal_job_ = job_key(farm_.journaled_jobs_++, job.kind, job.tasks, hash_of_job());
    }
  }

  // Whatever ends the job, nobody goes on with it.
  ~Run() {
    for (std::size_t r = 0; r < farm_.others_.size(); ++r) {
      Rank& rank = farm_.others_[r];
      rank.ready = false;
      if (started_) {
        farm_.tell(r, farm::kEndOfJob, to_send(pack(number_)));
      }
    }
  }

  void do_all() {
    const auto start = Clock::now();
    begin();
    Pause pause;
    while (!queue_.all_delivered()) {
      bool happened = take_local();  // all four, whatever the others say
      happened = hear() || happened;
      happened = deliver() || happened;
      happened = hand_out() || happened;
      check_timeouts();
      if (happened || Clock::now() - last_tick_ > kBetweenTicks) {
        last_tick_ = Clock::now();
        tick();
      }
      rest(pause.after({happened, farm_.ranks_.under_way() > 0, tasks_here() > 0}));
    }
    if (!job_.stays_here) {
      const std::chrono::duration<double> spent = Clock::now() - start;
      farm_.seconds_ += spent.count();
    }
  }

 private:
  // Bounds the results that wait for their turn, not the tasks under way: these are fewer.
  std::size_t window() const {
    return std::max<std::size_t>(64, kMostTasksAhead * static_cast<std::size_t>(farm_.threads_everywhere()));
  }

  void tick() const {
    if (tick_) {
      tick_(queue_.delivered());
    }
  }

  // What the journal has is done; the others are told about the job unless nothing is left for them.
  void begin() {
    std::size_t known = 0;
    for (std::size_t task = 0; journal_ != nullptr && task < job_.tasks; ++task) {
      if (journal_->has(journal_job_, task)) {
        queue_.finish(task);
        ++known;
      }
    }
    farm_.resumed_ += known;
    started_ = (known < job_.tasks || job_.broadcasts) && !farm_.others_.empty() && !job_.stays_here;
    if (started_) {
      hear();  // what was said since the last job
      const SharedBytes start = farm_.start_of(number_, job_.kind, job_.context);
      for (std::size_t r = 0; r < farm_.others_.size(); ++r) {
        farm_.others_[r].start_job();
        farm_.ask(r, start);
      }
    }
  }

  // Of all that its results and their layout depend on: another job may stand at this place when the journal is used
  // again, as where an object can be read now and could not be then.
  std::uint64_t hash_of_job() const {
    Packer packer;
    packer(farm::kProtocol);
    if (const Context& content = job_.identity ? job_.identity : job_.context) {
      content(packer);
    }
    std::uint64_t hash = hash_of(packer.take());
    for (std::size_t task = 0; task < job_.tasks; ++task) {
      hash = hash_of(job_.task(task), hash);
    }
    return hash;
  }

  void say(std::size_t other, farm::Tag tag, std::string bytes) const {
    farm_.ranks_.send(static_cast<int>(other) + 1, tag, to_send(std::move(bytes)));
  }

  // Few ranks, or nobody else there.
  bool works_here() const {
    const bool is_wanted = farm_.ranks_.size() <= farm_.policy_.most_ranks_to_work_beside;
    return job_.stays_here || is_wanted ||
           std::ranges::all_of(farm_.others_, [](const Rank& rank) { return rank.lost || rank.refused; });
  }

  // Those that our own threads have.
  std::size_t tasks_here() const { return crew_ ? crew_->tasks() : 0; }

  bool take_local() {
    bool taken = false;
    while (crew_) {
      std::optional<TaskResult> result = crew_->take();
      if (!result) {
        break;
      }
      farm_.busy_here_ += job_.stays_here ? 0.0 : result->seconds;
      accept(kHere, std::move(*result));
      taken = true;
    }
    return taken;
  }

  bool hear() {
    bool heard = false;
    while (std::optional<Message> message = farm_.ranks_.receive()) {
      heard = true;
      Rank& rank = farm_.others_[static_cast<std::size_t>(message->from) - 1];
      rank.heard();
      act_on(rank, *std::move(message));
    }
    return heard;
  }

  void act_on(Rank& rank, Message message) {
    Unpacker fields(message.bytes);
    switch (message.tag) {
      case farm::kReady:
        if (const auto ready = fields.next<farm::Ready>(); ready.job == number_) {
          rank.ready = true;
          rank.threads = ready.threads;
          queue_.set_window(window());
        }
        break;
      case farm::kRefusal:
        if (auto refusal = fields.next<farm::Refusal>(); refusal.job == number_) {
          rank.refuse(std::move(refusal.reason));
        }
        break;
      case farm::kResult: {
        std::uint32_t job = 0;
        TaskResult result = farm::unpack_result(std::move(message.bytes), job);
        rank.busy_seconds += result.seconds;
        if (job == number_) {
          rank.tasks -= rank.tasks > 0 ? 1 : 0;
          accept(message.from, std::move(result));
        }
        break;
      }
      default:
        farm_.greet(rank, message);
        break;
    }
  }

  // The first result of a task counts. What another rank could not do is done here: its host may lack what ours has,
  // and only so is a problem the same for any ranks.
  void accept(int from, TaskResult result) {
    if (from != kHere && result.outcome != TaskResult::Outcome::done) {
      if (!queue_.is_done(result.task)) {
        do_local(result.task);
      }
      return;
    }
    if (!queue_.finish(result.task)) {
      return;
    }
    if (from != kHere && farm_.policy_.counts_remote_tasks) {
      ++farm_.remote_tasks_[job_.kind];
    }
    median_.add(result.seconds);
    if (result.outcome == TaskResult::Outcome::done) {
      broadcast(from, result.task, result.bytes);
    }
    if (journal_ != nullptr && result.outcome == TaskResult::Outcome::done) {
      keep(result);
    }
    waiting_.emplace(result.task, std::move(result));
  }

  void keep(const TaskResult& result) {
    if (farm_.journal_is_full_ || (job_.is_worth_keeping && !job_.is_worth_keeping(result.bytes))) {
      return;
    }
    try {
      journal_->add(journal_job_, result.task, result.bytes);
    } catch (const RunError& problem) {
      if (!farm_.tell_journal_failure_) {
        throw;
      }
      farm_.journal_is_full_ = true;
      farm_.tell_journal_failure_(problem);
    }
  }

  // All but the rank that has made it.
  void broadcast(int from, std::size_t task, std::string_view result) {
    if (!started_ || !job_.broadcasts) {
      return;
    }
    if (!is_broadcast_) {
      is_broadcast_ = job_.broadcasts(result);
    }
    if (!is_broadcast_.value_or(false)) {
      return;
    }
    const SharedBytes bytes = to_send(Packer()(farm::TaskNumber{number_, task}).add_rest(result).take());
    for (std::size_t r = 0; r < farm_.others_.size(); ++r) {
      if (static_cast<int>(r) + 1 != from) {
        farm_.tell(r, farm::kBroadcast, bytes);  // one that misses it cannot take part in what needs it
      }
    }
  }

  bool deliver() {
    bool delivered = false;
    while (!queue_.all_delivered() && queue_.is_done(queue_.delivered())) {
      const std::size_t task = queue_.delivered();
      const auto found = waiting_.find(task);
      if (found == waiting_.end()) {
        std::optional<std::string> result = journal_->find(journal_job_, task);
        if (!result) {
          throw RunError("the journal can no longer be read");
        }
        broadcast(kHere, task, *result);
        job_.deliver(task, *std::move(result));
      } else {
        TaskResult result = std::move(found->second);
        waiting_.erase(found);
        if (result.outcome != TaskResult::Outcome::done) {
          result.throw_problem();
        }
        job_.deliver(task, std::move(result.bytes));
      }
      queue_.deliver();
      delivered = true;
    }
    return delivered;
  }

  bool hand_out() {
    bool handed = false;
    const auto now = Clock::now();
    const TaskQueue::Seconds patience(std::max(1.0, 5.0 * median_.value()));
    // In turns: the first tasks of a small job must not all queue up at one rank, nor its last.
    const std::size_t turns = tasks_ahead();
    for (std::size_t turn = 0; turn < turns; ++turn) {
      for (std::size_t r = 0; r < farm_.others_.size(); ++r) {
        Rank& rank = farm_.others_[r];
        while (rank.ready && !rank.lost && rank.tasks < (turn + 1) * static_cast<std::size_t>(rank.threads)) {
          const auto task = queue_.next_for(static_cast<int>(r) + 1, now, patience);
          if (!task) {
            break;
          }
          say(r, farm::kTask, pack(farm::TaskNumber{number_, *task}) + job_.task(*task));
          ++rank.tasks;
          handed = true;
        }
      }
      const std::size_t here = std::min(turn + 1, kTasksAhead) * static_cast<std::size_t>(farm_.threads_);
      handed = hand_out_here(here, now, patience) || handed;
    }
    return handed;
  }

  // Of a thread of another rank.
  std::size_t tasks_ahead() const {
    const double tasks = median_.value() > 0.0 ? kSecondsAhead / median_.value() : 0.0;
    return static_cast<std::size_t>(
        std::clamp(tasks, static_cast<double>(kTasksAhead), static_cast<double>(kMostTasksAhead)));
  }

  bool hand_out_here(std::size_t most, Clock::time_point now, TaskQueue::Seconds patience) {
    bool handed = false;
    while (tasks_here() < most && works_here()) {
      const auto task = queue_.next_for(kHere, now, patience);
      if (!task) {
        break;
      }
      do_local(*task);
      handed = true;
    }
    return handed;
  }

  void do_local(std::size_t task) {
    if (!crew_) {
      crew_ = std::make_unique<ThreadCrew>(job_.work, farm_.threads_);
    }
    crew_->give(task, job_.task(task));
  }

  // Takes tasks back from ranks that say nothing.
  void check_timeouts() {
    const auto now = Clock::now();
    const auto since = now - farm_.last_look_;
    if (since < kBetweenTicks) {
      return;
    }
    const Clock::duration away = since > kStall ? since : Clock::duration(0);
    farm_.last_look_ = now;
    for (std::size_t r = 0; started_ && r < farm_.others_.size(); ++r) {
      Rank& rank = farm_.others_[r];
      rank.last_heard = std::max(std::min(rank.last_heard + away, now), farm_.ranks_.heard(static_cast<int>(r) + 1));
      const bool is_away = rank.left || now - rank.last_heard > silence_deadline() || farm::has_gone(rank.greeting) ||
                           farm_.ranks_.is_cut_off(static_cast<int>(r) + 1);
      if (!rank.lost && !rank.refused && is_away) {
        rank.lost = true;
        rank.tasks = 0;
        farm_.handed_out_again_ += queue_.take_back(static_cast<int>(r) + 1);
      }
    }
  }

  void rest(std::chrono::microseconds pause) {
    if (!started_) {
      pause = kBetweenTicks;  // a finished task wakes us
    }
    if (queue_.all_delivered()) {
      return;
    }
    rest_beside(crew_.get(), pause);
  }

  TaskFarm& farm_;
  const Job& job_;
  const Tick& tick_;
  const std::uint32_t number_;
  Journal* journal_ = nullptr;  // null where this job is not in one
  std::uint64_t journal_job_ = 0;
  bool started_ = false;              // the others were told
  std::optional<bool> is_broadcast_;  // whether they are told all results
  TaskQueue queue_;
  std::map<std::size_t, TaskResult> waiting_;  // for their turn
  RunningMedian median_;                       // seconds a task takes
  Clock::time_point last_tick_;
  std::unique_ptr<ThreadCrew> crew_;
};

void TaskFarm::run(const Job& job, const Tick& tick) {
  Run(*this, job, tick).do_all();
}

}  // namespace spincat
