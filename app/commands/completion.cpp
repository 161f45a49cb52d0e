#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "app/commands/commands.h"
#include "app/terminal/completions.h"
#include "spincat/error.h"

namespace spincat::app {
namespace {

struct Shell {
  std::string_view name;
  std::string (*completions)(const CLI::App& command);
};

constexpr std::array<Shell, 3> kShells = {
    {{"bash", bash_completions}, {"zsh", zsh_completions}, {"fish", fish_completions}}};

}  // namespace

Command add_completion(CLI::App& parent) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = parent.add_subcommand("completion", "Print what a shell needs to complete commands and options");
  command->footer(
      "Example:\n"
      "  source <(spincat completion bash)\n"
      "  spincat completion fish > ~/.config/fish/completions/spincat.fish");
  command->add_option("shell", *name, "bash, zsh or fish")->type_name("SHELL")->required();
  return [name, &parent](TaskFarm&) {
    for (const Shell& shell : kShells) {
      if (shell.name == *name) {
        fmt::print("{}", shell.completions(parent));
        return 0;
      }
    }
    throw InputError(fmt::format("there are no completions for '{}' (bash, zsh or fish)", *name));
  };
}

}  // namespace spincat::app
