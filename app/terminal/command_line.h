// The command line as it was given, for reports that say how to repeat a run.
#pragma once

#include <string>
#include <vector>

namespace spincat::app {

// Kept once, at the start.
void keep_command_line(int argc, char** argv);

// Word by word, "spincat" first, whatever path the program was called by.
const std::vector<std::string>& command_line();

}  // namespace spincat::app
