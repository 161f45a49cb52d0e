// How --help looks: CLI11's way, in lines that a terminal of 80 columns does not break.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace spincat::app {

class HelpFormat : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace spincat::app
