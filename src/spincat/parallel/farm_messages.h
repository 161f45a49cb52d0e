// What rank 0 and the others say to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "spincat/parallel/packing.h"
#include "spincat/parallel/task.h"

namespace spincat::farm {

// Raised whenever a message changes: ranks of different versions must not work together.
inline constexpr std::uint32_t kProtocol = 4;

enum Tag : int {
  kHello,     // to rank 0 and from it: Greeting
  kJob,       // from rank 0: JobStart and its context
  kReady,     // to rank 0: job, threads
  kRefusal,   // to rank 0: job, reason
  kTask,      // from rank 0: job, task, its bytes
  kResult,    // to rank 0: TaskResult, job
  kBeat,      // to rank 0 and from it: still there
  kTold,      // from rank 0: job, task, the result of another rank
  kEndOfJob,  // from rank 0: job
  kQuit,      // from rank 0: no more tasks
  kBye,       // to rank 0: the last word
  kEnd,       // from rank 0: all have said theirs
};

// How a rank introduces itself.
struct Greeting {
  std::uint32_t protocol = kProtocol;
  std::string program;  // name and version
  std::string host;
  std::string processes;  // which process numbers are valid together: of one kernel and PID namespace
  std::int64_t process = 0;
};

struct JobStart {
  std::uint32_t job = 0;
  std::int32_t threads = 0;  // as asked for by the user; 0 means what is there
  std::string_view kind;
};

Greeting own_greeting();
std::string pack(const Greeting& greeting);
Greeting unpack_greeting(std::string_view bytes);

// Whether this is another process whose state we can see: of our host and our container.
bool is_in_our_sight(const Greeting& greeting);

// Whether it has ended; false where that cannot be seen.
bool has_gone(const Greeting& greeting);

// Its context follows: it may be large, and need not be copied.
void pack_job_start(const JobStart& start, Packer& packer);
JobStart unpack_job_start(Unpacker& fields);  // points into the bytes

// The result's bytes come first, so that neither side copies them.
std::string pack(std::uint32_t job, TaskResult result);
TaskResult unpack_result(std::string bytes, std::uint32_t& job);

}  // namespace spincat::farm
