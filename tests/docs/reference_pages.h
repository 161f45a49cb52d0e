// The pages of docs/reference that are generated, so that they cannot differ from the program.
#pragma once

#include <string>

namespace spincat::test {

// docs/reference/command.md: what `COMMAND --help` prints, and the same of each of its subcommands in their order.
std::string command_page(const std::string& command);

// docs/reference/settings.md: what `COMMAND settings --json` lists, a table for each stage.
std::string settings_page(const std::string& command);

}  // namespace spincat::test
