#include "app/terminal/messages.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "spincat/report/text_table.h"

namespace spincat::app {

void message(std::string_view text) {
  print_to_stderr("spincat: " + printable(text) + "\n");
}

void print_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) {
      // In a mode that makes reading from standard input end, and writing to standard output fail as it should. The
      // lowest free number is taken, which is this stream's.
      static_cast<void>(open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
    }
  }
}

}  // namespace spincat::app
