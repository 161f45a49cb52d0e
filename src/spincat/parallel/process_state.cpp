#include "spincat/parallel/process_state.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace spincat {
namespace {

// 'R' running, 'T' stopped, 'Z' dead, ... (man 5 proc); 0 where it cannot be read.
char state_of(std::int64_t process) {
  std::ifstream stream(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(stream, line);
  const std::size_t name_end = line.rfind(')');  // the name may hold anything
  return name_end == std::string::npos || name_end + 2 >= line.size() ? '\0' : line[name_end + 2];
}

// Empty where it cannot be seen.
std::filesystem::path program_of(std::int64_t process) {
  std::error_code error;
  return std::filesystem::read_symlink(fmt::format("/proc/{}/exe", process), error);
}

}  // namespace

bool is_there(std::int64_t process) {
  if (::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) {
    return false;
  }
  const char state = state_of(process);
  return state != 'Z' && state != 'X';
}

bool is_stopped(std::int64_t process) {
  return state_of(process) == 'T';
}

bool runs_our_program(std::int64_t process) {
  static const std::filesystem::path own = program_of(getpid());
  return !own.empty() && program_of(process) == own;
}

}  // namespace spincat
