// What a shell needs to complete the words of a command line.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace spincat::app {

// Scripts for one shell each, made of the options that the commands have declared.
std::string bash_completions(const CLI::App& command);
std::string zsh_completions(const CLI::App& command);
std::string fish_completions(const CLI::App& command);

}  // namespace spincat::app
