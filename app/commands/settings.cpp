#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/terminal/terminal.h"
#include "spincat/report/settings_report.h"

namespace spincat::app {

Command add_settings(CLI::App& parent) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = parent.add_subcommand("settings", "List all settings: ranges, and the default of each preset");
  command->footer(
      "Example:\n"
      "  spincat settings\n"
      "  spincat sweep models/ --vary spin_points=64,128,256");
  command->add_flag("--json", *json, "Print JSON for programs instead of a table");
  return [json](TaskFarm&) {
    fmt::print("{}",
               *json ? settings_list_json() + "\n" : settings_list_text(terminal_width(STDOUT_FILENO, kPipeWidth)));
    return 0;
  };
}

}  // namespace spincat::app
