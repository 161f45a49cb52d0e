#include "spincat/parallel/farm_messages.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <utility>

#include "spincat/error.h"
#include "spincat/parallel/process_state.h"
#include "spincat/version.h"

namespace spincat::farm {

Greeting own_greeting() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) {
    host = {'?', '\0'};
  }
  struct stat processes = {};
  const bool known = ::stat("/proc/self/ns/pid", &processes) == 0;
  Greeting greeting;
  greeting.program = kProgram;
  greeting.host = host.data();
  std::string boot;  // hosts may have the same name
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  greeting.processes = greeting.host + "/" + boot + "/" + std::to_string(known ? processes.st_ino : 0);
  greeting.process = getpid();
  return greeting;
}

bool is_in_our_sight(const Greeting& greeting) {
  static const Greeting own = own_greeting();
  return greeting.process > 0 && greeting.process != own.process && greeting.processes == own.processes;
}

bool has_gone(const Greeting& greeting) {
  return is_in_our_sight(greeting) && !is_there(greeting.process);
}

// What a result is but for its bytes.
struct ResultHead {
  std::uint64_t task = 0;
  TaskResult::Outcome outcome = TaskResult::Outcome::done;
  double seconds = 0.0;
  std::string file;
  std::uint32_t job = 0;
};

void fields(auto& archive, MessageOf<ResultHead> auto& head) {
  auto& [task, outcome, seconds, file, job] = head;
  archive(task, outcome, seconds, file, job);
}

std::string pack_result(std::uint32_t job, TaskResult result) {
  auto& [task, outcome, bytes, file, seconds] = result;  // does not compile when a member is forgotten
  const std::string head = pack(ResultHead{task, outcome, seconds, std::move(file), job});
  return std::move(bytes.append(head).append(pack(static_cast<std::uint64_t>(head.size()))));
}

TaskResult unpack_result(std::string bytes, std::uint32_t& job) {
  const auto from_end = [&](std::uint64_t size) {
    if (size > bytes.size()) {
      throw RunError("a message between ranks ends early");
    }
    return bytes.size() - size;
  };
  const std::size_t length = from_end(sizeof(std::uint64_t));
  const auto head_size = unpack<std::uint64_t>(std::string_view(bytes).substr(length));
  bytes.resize(length);
  const std::size_t begin = from_end(head_size);
  auto head = unpack<ResultHead>(std::string_view(bytes).substr(begin));
  bytes.resize(begin);
  job = head.job;
  return {head.task, head.outcome, std::move(bytes), std::move(head.file), head.seconds};
}

}  // namespace spincat::farm
