// What rank 0 and the others say to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "spincat/parallel/packing.h"
#include "spincat/parallel/task.h"

namespace spincat::farm {

// Raised whenever a message or a result changes: ranks of different versions must not work together, nor a journal be
// taken for one of ours.
inline constexpr std::uint32_t kProtocol = 6;

enum Tag : int {
  kHello,      // to rank 0 and from it: Greeting
  kJob,        // from rank 0: JobStart and its context
  kReady,      // to rank 0: Ready
  kRefusal,    // to rank 0: Refusal
  kTask,       // from rank 0: TaskNumber, the task's bytes
  kResult,     // to rank 0: TaskResult, job
  kBeat,       // to rank 0 and from it: still there
  kBroadcast,  // from rank 0: TaskNumber, the result of another rank
  kEndOfJob,   // from rank 0: job
  kQuit,       // from rank 0: no more tasks
  kBye,        // to rank 0: the last word
  kEnd,        // from rank 0: all have said theirs
};

// How a rank introduces itself.
struct Greeting {
  std::uint32_t protocol = kProtocol;
  std::string program;  // name and version
  std::string host;
  std::string processes;  // which process numbers are valid together: of one kernel and PID namespace
  std::int64_t process = 0;
};

// Of another protocol only the first two are known to be where they are here.
void fields(auto& archive, MessageOf<Greeting> auto& greeting) {
  auto& [protocol, program, host, processes, process] = greeting;
  archive(protocol, program);
  if (protocol == kProtocol) {
    archive(host, processes, process);
  }
}

struct JobStart {
  std::uint32_t job = 0;
  std::int32_t threads = 0;  // as asked for by the user; 0 means what is there
  std::string_view kind;
};

// Its context follows, as a task's bytes or a result follow its number: they may be large, and need not be copied.
void fields(auto& archive, MessageOf<JobStart> auto& start) {
  auto& [job, threads, kind] = start;
  archive(job, threads, kind);
}

struct Ready {
  std::uint32_t job = 0;
  std::int32_t threads = 0;
};

void fields(auto& archive, MessageOf<Ready> auto& ready) {
  auto& [job, threads] = ready;
  archive(job, threads);
}

struct Refusal {
  std::uint32_t job = 0;
  std::string reason;
};

void fields(auto& archive, MessageOf<Refusal> auto& refusal) {
  auto& [job, reason] = refusal;
  archive(job, reason);
}

struct TaskNumber {
  std::uint32_t job = 0;
  std::uint64_t task = 0;
};

void fields(auto& archive, MessageOf<TaskNumber> auto& number) {
  auto& [job, task] = number;
  archive(job, task);
}

Greeting own_greeting();

// Whether this is another process whose state we can see: of our host and our container.
bool is_in_our_sight(const Greeting& greeting);

// Whether it has ended; false where that cannot be seen.
bool has_gone(const Greeting& greeting);

// The result's bytes come first, so that neither side copies them.
std::string pack_result(std::uint32_t job, TaskResult result);
TaskResult unpack_result(std::string bytes, std::uint32_t& job);

}  // namespace spincat::farm
