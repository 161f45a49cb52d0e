#include "app/terminal/completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

namespace spincat::app {
namespace {

using Commands = std::vector<const CLI::App*>;
using Options = std::vector<const CLI::Option*>;

Commands commands_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

// Those that begin with a dash.
Options options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}

std::vector<std::string> words_of(const CLI::Option& option) {
  std::vector<std::string> words;
  for (const std::string& name : option.get_snames()) {
    words.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    words.push_back("--" + name);
  }
  return words;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// Each of `characters` in the text gets a backslash before it.
std::string escaped(std::string_view text, std::string_view characters) {
  std::string result;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) {
      result += '\\';
    }
    result += c;
  }
  return result;
}

// As one word of a shell, whatever is in it.
std::string as_word(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result + "'";
}

std::string all_words(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::Option* option : options_of(command)) {
    const std::vector<std::string> more = words_of(*option);
    words.insert(words.end(), more.begin(), more.end());
  }
  return fmt::format("{}", fmt::join(words, " "));
}

// The option's words as _arguments has them, each with what it does.
std::string zsh_arguments(const CLI::App& command) {
  std::string result;
  for (const CLI::Option* option : options_of(command)) {
    for (const std::string& word : words_of(*option)) {
      const std::string value = takes_value(*option) ? ":value:_files" : "";
      const std::string_view joins = takes_value(*option) && word.starts_with("--") ? "=" : "";
      result += " \\\n        " +
                as_word(fmt::format("{}{}[{}]{}", word, joins, escaped(option->get_description(), "[]:\\"), value));
    }
  }
  return result + " \\\n        '*:file:_files'";
}

std::string fish_options(const CLI::App& command, const std::string& condition) {
  std::string result;
  for (const CLI::Option* option : options_of(command)) {
    result += fmt::format("complete -c spincat -n {}", as_word(condition));
    for (const std::string& name : option->get_snames()) {
      result += " -s " + name;
    }
    for (const std::string& name : option->get_lnames()) {
      result += " -l " + name;
    }
    result += fmt::format("{} -d {}\n", takes_value(*option) ? " -r" : "", as_word(option->get_description()));
  }
  return result;
}

}  // namespace

std::string bash_completions(const CLI::App& command) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* one : commands_of(command)) {
    names.push_back(one->get_name());
    cases += fmt::format("    {}) words={} ;;\n", one->get_name(), as_word(all_words(*one)));
  }
  return fmt::format(R"(# Completions of spincat for bash: source this file, or keep it as
# ~/.local/share/bash-completion/completions/spincat
_spincat() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} words=''
  COMPREPLY=()
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [ "$COMP_CWORD" -eq 1 ]; then
    words={}
  elif [[ $current != -* ]]; then
    return
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _spincat spincat
)",
                     cases, as_word(fmt::format("{} {}", fmt::join(names, " "), all_words(command))));
}

std::string zsh_completions(const CLI::App& command) {
  std::string commands;
  std::string cases;
  for (const CLI::App* one : commands_of(command)) {
    commands += " \\\n        " + as_word(one->get_name() + ":" + one->get_description());
    cases += fmt::format("      {}) _arguments{} ;;\n", one->get_name(), zsh_arguments(*one));
  }
  return fmt::format(R"(#compdef spincat
# Completions of spincat for zsh: keep this file as _spincat in a folder of $fpath.
_spincat() {{
  local curcontext="$curcontext" line state state_descr
  local -a commands
  typeset -A opt_args
  _arguments -C '1: :->command' '*::argument:->arguments'
  case $state in
    command)
      commands=({})
      _describe command commands ;;
    arguments) case $words[1] in
{}      esac ;;
  esac
}}
_spincat "$@"
)",
                     commands, cases);
}

std::string fish_completions(const CLI::App& command) {
  std::string result = "# Completions of spincat for fish: keep this file as ~/.config/fish/completions/spincat.fish\n";
  result += fish_options(command, "__fish_use_subcommand");
  for (const CLI::App* one : commands_of(command)) {
    result += fmt::format("complete -c spincat -f -n __fish_use_subcommand -a {} -d {}\n", one->get_name(),
                          as_word(one->get_description()));
    result += fish_options(*one, "__fish_seen_subcommand_from " + one->get_name());
  }
  return result;
}

}  // namespace spincat::app
