// TUM's list of the depth pictures of a recording.
#pragma once

#include <deque>
#include <string>
#include <string_view>

namespace spincat {

struct ListedFrame {
  std::string file;   // as the list names it
  double time = 0.0;  // seconds
};

// A deque: a list may have millions of lines, and a vector that grows holds them twice.
using FrameList = std::deque<ListedFrame>;

// Reads lines "time file"; empty lines and those that begin with # say nothing. Throws InputError (without a file name)
// that names the line.
FrameList parse_depth_list(std::string_view text);

}  // namespace spincat
