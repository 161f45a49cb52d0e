// What is known of the terminal behind a stream.
#pragma once

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <string_view>

namespace spincat::app {

inline constexpr std::size_t kPipeWidth = 160;  // a pipe is taken to be wide

// Columns of the terminal behind a file descriptor; `otherwise` where there is no terminal or it does not tell.
inline std::size_t terminal_width(int descriptor, std::size_t otherwise) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : otherwise;
}

inline bool is_terminal(int descriptor) {
  return isatty(descriptor) == 1;
}

// A terminal that knows colours, whose user has not said NO_COLOR (no-color.org).
inline bool shows_colours(int descriptor) {
  const char* const refused = std::getenv("NO_COLOR");
  const char* const kind = std::getenv("TERM");
  return is_terminal(descriptor) && (refused == nullptr || *refused == '\0') && kind != nullptr &&
         std::string_view(kind) != "dumb" && *kind != '\0';
}

}  // namespace spincat::app
