#include "app/commands/commands.h"

namespace spincat::app {

#define COMMAND(name) Command add_##name(CLI::App& parent);
#include "app/commands/commands.inc"
#undef COMMAND

std::vector<NamedCommand> add_commands(CLI::App& parent) {
  return {
#define COMMAND(name) {#name, add_##name(parent)},
#include "app/commands/commands.inc"
#undef COMMAND
  };
}

}  // namespace spincat::app
