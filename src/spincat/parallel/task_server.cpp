#include "spincat/parallel/task_server.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <thread>
#include <utility>

#include "spincat/parallel/farm_messages.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/pause.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/parallel/thread_crew.h"

namespace spincat {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenBeats(200);
constexpr std::chrono::milliseconds kBetweenLooksAtMasters(500);
constexpr std::chrono::milliseconds kStall(500);  // when we were away so long ourselves, silence means nothing
constexpr double kPatience = 150.0;               // with rank 0, in deadlines for silence

class Server {
 public:
  Server(Communicator& ranks, const WorkFactory& factory, const ServiceRules& rules)
      : ranks_(ranks), factory_(factory), rules_(rules), parent_(getppid()) {
    say(farm::kHello, pack(farm::own_greeting()));
  }

  // Says good-bye whatever ends the work, so that nobody waits for it; and stays until all have, as MPI ends well only
  // where all come to its end together.
  ServiceEnd run() {
    std::exception_ptr problem;
    try {
      work(rules_.keep_going);
    } catch (...) {
      problem = std::current_exception();
    }
    leave();
    work([] {});
    if (problem) {
      std::rethrow_exception(problem);
    }
    return ended_ ? ServiceEnd::dismissed : is_abandoned() ? ServiceEnd::abandoned : ServiceEnd::cut_off;
  }

 private:
  void work(const std::function<void()>& keep_going) {
    Pause pause;
    while (!ended_ && !is_abandoned() && !ranks_.is_cut_off(0)) {
      keep_going();
      bool happened = hear();
      happened = answer() || happened;  // both
      beat();
      rest(pause.after({happened, ranks_.under_way() > 0, crew_ && crew_->tasks() > 0}));
    }
  }

  void leave() {
    if (!left_) {
      end_crew();
      say(farm::kBye, {});
      left_ = true;
    }
  }

  // Waits for the tasks that are under way; a rank that is heard is not given up.
  void end_crew() {
    if (!crew_) {
      return;
    }
    crew_->forget();
    while (crew_->tasks() > 0) {
      if (!crew_->take()) {
        crew_->wait(kBetweenBeats);
        beat();
      }
    }
    crew_.reset();
  }

  void say(farm::Tag tag, std::string bytes) {
    ranks_.send(0, tag, std::make_shared<const std::string>(std::move(bytes)));
    last_said_ = Clock::now();
  }

  bool hear() {
    bool heard = false;
    while (!ended_) {
      const std::optional<Message> message = ranks_.receive();
      if (!message) {
        break;
      }
      heard = true;
      act_on(*message);
    }
    return heard;
  }

  void act_on(const Message& message) {
    if (left_ && message.tag != farm::kEnd && message.tag != farm::kHello) {
      return;
    }
    switch (message.tag) {
      case farm::kHello:
        rank0_ = unpack<farm::Greeting>(message.bytes);
        break;
      case farm::kJob:
        start_job(message.bytes);
        break;
      case farm::kTask: {
        Unpacker fields(message.bytes);
        const auto [job, task] = fields.next<farm::TaskNumber>();
        if (crew_ && job == job_) {
          crew_->give(task, std::string(fields.rest()));
        }
        break;
      }
      case farm::kBroadcast: {
        Unpacker fields(message.bytes);
        const auto [job, task] = fields.next<farm::TaskNumber>();
        if (crew_ && job == job_) {
          keep(task, fields.rest());
        }
        break;
      }
      case farm::kEndOfJob:
        end_crew();
        break;
      case farm::kQuit:
        leave();
        break;
      case farm::kEnd:
        ended_ = true;
        break;
      default:
        break;
    }
  }

  void start_job(std::string_view bytes) {
    end_crew();
    Unpacker fields(bytes);
    const auto start = fields.next<farm::JobStart>();
    job_ = start.job;
    try {
      const int threads = rules_.thread_count(start.threads);
      RankWork work = factory_(start.kind, fields.rest());
      keep_ = std::move(work.keep);
      crew_ = std::make_unique<ThreadCrew>(std::move(work.work), threads);
      say(farm::kReady, pack(farm::Ready{job_, threads}));
    } catch (const std::exception& error) {
      say(farm::kRefusal, pack(farm::Refusal{job_, error.what()}));
    }
  }

  // A rank that could not keep a result (no memory) refuses the job that needs it.
  void keep(std::size_t task, std::string_view result) {
    try {
      if (keep_) {
        keep_(task, result);
      }
    } catch (const std::exception&) {
      keep_ = {};
    }
  }

  bool answer() {
    bool answered = false;
    while (crew_) {
      std::optional<TaskResult> result = crew_->take();
      if (!result) {
        break;
      }
      answered = true;
      if (result->outcome == TaskResult::Outcome::done) {
        keep(result->task, result->bytes);
      }
      say(farm::kResult, farm::pack_result(job_, *std::move(result)));
    }
    return answered;
  }

  // Tells rank 0 that long tasks and long messages are no sign of death.
  void beat() {
    if (!left_ && (crew_ || ranks_.under_way() > 0) && Clock::now() - last_said_ > kBetweenBeats) {
      say(farm::kBeat, {});
    }
  }

  // Whoever starts ranks waits for them; when that process is gone, or rank 0, nobody wants the results any more.
  bool is_abandoned() {
    const auto now = Clock::now();
    if (now - last_turn_ > kStall) {
      awake_since_ = now;
    }
    last_turn_ = now;
    if (now - looked_ > kBetweenLooksAtMasters) {
      looked_ = now;
      abandoned_ = abandoned_ || getppid() != parent_ || farm::has_gone(rank0_) || is_silent(now);
    }
    return abandoned_;
  }

  // Rank 0, on a host where nothing else tells us whether it is there.
  bool is_silent(Clock::time_point now) const {
    return rules_.leaves_silent_rank0 && !farm::is_in_our_sight(rank0_) &&
           now - std::max(awake_since_, ranks_.heard(0)) > kPatience * silence_deadline();
  }

  void rest(std::chrono::microseconds pause) { rest_beside(crew_.get(), pause); }

  Communicator& ranks_;
  const WorkFactory& factory_;
  const ServiceRules& rules_;
  const pid_t parent_;
  std::unique_ptr<ThreadCrew> crew_;  // of the job that is on
  std::function<void(std::size_t task, std::string_view result)> keep_;
  std::uint32_t job_ = 0;
  farm::Greeting rank0_;
  bool left_ = false;
  bool ended_ = false;
  bool abandoned_ = false;
  Clock::time_point looked_ = Clock::now();
  Clock::time_point last_turn_ = looked_;
  Clock::time_point awake_since_ = looked_;
  Clock::time_point last_said_;
};

}  // namespace

ServiceEnd serve(Communicator& ranks, const WorkFactory& factory, const ServiceRules& rules) {
  return Server(ranks, factory, rules).run();
}

}  // namespace spincat
