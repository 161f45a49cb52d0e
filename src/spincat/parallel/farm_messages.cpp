#include "spincat/parallel/farm_messages.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <utility>

#include "spincat/error.h"
#include "spincat/parallel/process_state.h"

namespace spincat::farm {

Greeting own_greeting() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) {
    host = {'?', '\0'};
  }
  struct stat processes = {};
  const bool known = ::stat("/proc/self/ns/pid", &processes) == 0;
  Greeting greeting;
  greeting.program = "spincat " SPINCAT_VERSION;
  greeting.host = host.data();
  std::string boot;  // hosts may have the same name
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  greeting.processes = greeting.host + "/" + boot + "/" + std::to_string(known ? processes.st_ino : 0);
  greeting.process = getpid();
  return greeting;
}

std::string pack(const Greeting& greeting) {
  return Packer()
      .add(greeting.protocol)
      .add(greeting.program)
      .add(greeting.host)
      .add(greeting.processes)
      .add(greeting.process)
      .take();
}

Greeting unpack_greeting(std::string_view bytes) {
  Unpacker fields(bytes);
  Greeting greeting;
  greeting.protocol = fields.get<std::uint32_t>();
  greeting.program = fields.get_text();
  if (greeting.protocol != kProtocol) {
    return greeting;  // nothing else is known to be where it is here
  }
  greeting.host = fields.get_text();
  greeting.processes = fields.get_text();
  greeting.process = fields.get<std::int64_t>();
  return greeting;
}

bool is_in_our_sight(const Greeting& greeting) {
  static const Greeting own = own_greeting();
  return greeting.process > 0 && greeting.process != own.process && greeting.processes == own.processes;
}

bool has_gone(const Greeting& greeting) {
  return is_in_our_sight(greeting) && !is_there(greeting.process);
}

void pack_job_start(const JobStart& start, Packer& packer) {
  packer.add(start.job).add(start.threads).add(start.kind);
}

JobStart unpack_job_start(Unpacker& fields) {
  JobStart start;
  start.job = fields.get<std::uint32_t>();
  start.threads = fields.get<std::int32_t>();
  start.kind = fields.get_text();
  return start;
}

std::string pack(std::uint32_t job, TaskResult result) {
  const std::string rest = Packer()
                               .add(static_cast<std::uint64_t>(result.task))
                               .add(result.outcome)
                               .add(result.seconds)
                               .add(result.file)
                               .add(job)
                               .take();
  std::string bytes = std::move(result.bytes);
  return bytes.append(rest).append(Packer().add(static_cast<std::uint64_t>(rest.size())).take());
}

TaskResult unpack_result(std::string bytes, std::uint32_t& job) {
  const auto from_end = [&](std::uint64_t size) {
    if (size > bytes.size()) {
      throw RunError("a message between ranks ends early");
    }
    return bytes.size() - size;
  };
  const std::size_t length = from_end(sizeof(std::uint64_t));
  const auto rest_size = Unpacker(std::string_view(bytes).substr(length)).get<std::uint64_t>();
  bytes.resize(length);
  const std::size_t begin = from_end(rest_size);
  Unpacker fields(std::string_view(bytes).substr(begin));
  TaskResult result;
  result.task = fields.get<std::uint64_t>();
  result.outcome = fields.get<TaskResult::Outcome>();
  result.seconds = fields.get<double>();
  result.file = fields.get_text();
  job = fields.get<std::uint32_t>();
  bytes.resize(begin);
  result.bytes = std::move(bytes);
  return result;
}

}  // namespace spincat::farm
