// The subcommands, one file and one line of commands.inc each.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace spincat {
class TaskFarm;
}

namespace spincat::app {

// What is to be run when a subcommand was chosen, with the other ranks of this run at its service. Returns the exit
// code and throws spincat::Error.
using Command = std::function<int(TaskFarm& farm)>;

struct NamedCommand {
  std::string name;
  Command run;
};

// Has every subcommand declare its options on a CLI::App of its own below `parent`.
std::vector<NamedCommand> add_commands(CLI::App& parent);

}  // namespace spincat::app
