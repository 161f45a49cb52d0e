#include "app/terminal/help_format.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <sstream>

#include "app/terminal/terminal.h"
#include "spincat/report/text_table.h"

namespace spincat::app {
namespace {

// As wide as the terminal, but no wider than is good to read; 80 in a pipe.
std::size_t help_width() {
  return std::clamp<std::size_t>(terminal_width(STDOUT_FILENO, 80), 60, 100);
}

}  // namespace

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), help_width() - column_width_);
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_display_name(true),
                           wrapped(command->get_description(), help_width() - column_width_), column_width_);
  return out.str();
}

std::string HelpFormat::make_description(const CLI::App* app) const {
  return wrapped(CLI::Formatter::make_description(app), help_width());
}

// Examples begin with blanks and stay as they are.
std::string HelpFormat::make_footer(const CLI::App* app) const {
  std::istringstream lines(CLI::Formatter::make_footer(app));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    text += (line.starts_with(' ') ? line : wrapped(line, help_width())) + "\n";
  }
  return text;
}

}  // namespace spincat::app
