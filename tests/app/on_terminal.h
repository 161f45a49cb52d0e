// The command on a pseudo-terminal of a given width.
#pragma once

#include <fmt/format.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace spincat::test {

struct OnTerminal {
  int code = -1;     // -1: ended by a signal
  std::string text;  // everything that was written to the terminal
};

// `environment` stands before the command.
inline OnTerminal on_terminal(const std::filesystem::path& folder, unsigned short columns,
                              const std::string& environment, const std::string& arguments) {
  winsize size{};
  size.ws_row = 24;
  size.ws_col = columns;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    const std::string line =
        fmt::format("cd '{}' && {} '{}' {}", folder.string(), environment, SPINCAT_COMMAND, arguments);
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  OnTerminal ran;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(terminal, buffer, sizeof(buffer))) > 0;) {  // EIO when the command has ended
    ran.text.append(buffer, static_cast<std::size_t>(got));
  }
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::erase(ran.text, '\r');
  return ran;
}

}  // namespace spincat::test
