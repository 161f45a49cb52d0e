// What is known of the terminal behind a stream.
#pragma once

#include <sys/ioctl.h>

#include <cstddef>

namespace spincat::app {

// Columns of the terminal behind a file descriptor; `otherwise` where there is no terminal or it does not tell.
inline std::size_t terminal_width(int descriptor, std::size_t otherwise) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : otherwise;
}

}  // namespace spincat::app
