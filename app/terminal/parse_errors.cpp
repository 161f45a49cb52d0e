#include "app/terminal/parse_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace spincat::app {
namespace {

// The subcommand that was asked for, or the command itself.
const CLI::App& called(const CLI::App& cli) {
  const auto commands = cli.get_subcommands();
  return commands.empty() ? cli : *commands.back();
}

std::string hint(const CLI::App& cli) {
  const CLI::App& command = called(cli);
  return &command == &cli ? "spincat --help" : fmt::format("spincat {} --help", command.get_name());
}

// How many letters must be put in, left out or changed to make one word of the other (V. I. Levenshtein, 1966).
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// The option of the subcommand that is most like the word; nothing where none is like it.
std::optional<std::string> like(const CLI::App& command, std::string_view word) {
  constexpr std::size_t kMostEdits = 2;
  std::optional<std::string> best;
  std::size_t fewest = kMostEdits + 1;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const std::size_t edits = edits_between("--" + name, word);
      if (edits < fewest) {
        fewest = edits;
        best = "--" + name;
      }
    }
  }
  return best;
}

std::string unexpected_text(const CLI::App& cli) {
  const std::vector<std::string> words = cli.remaining(true);
  const std::string word = words.empty() ? "" : words.front();
  if (!word.starts_with('-')) {
    return fmt::format("unexpected argument '{}' ({})", word, hint(cli));
  }
  const std::string name = word.substr(0, word.find('='));
  const auto meant = like(called(cli), name);
  return meant ? fmt::format("unknown option {}; did you mean {}? ({})", name, *meant, hint(cli))
               : fmt::format("unknown option {} ({})", name, hint(cli));
}

// "files is required".
std::string missing_text(const CLI::App& cli, std::string_view what) {
  const CLI::App& command = called(cli);
  std::string name(what.substr(0, what.find(" is required")));
  const CLI::Option* option = command.get_option_no_throw(name);
  if (&command == &cli || option == nullptr) {
    return fmt::format("a command is missing ({})", hint(cli));
  }
  if (option->get_positional()) {
    const bool several = name.ends_with('s');
    name = (several ? "at least one " : "a ") + option->get_type_name();
  }
  return fmt::format("{} needs {} ({})", command.get_name(), name, hint(cli));
}

}  // namespace

CLI::Validator in_range(const Range& range) {
  const auto check = [range](std::string& text) -> std::string {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc{} && end == text.data() + text.size();
    return is_number && range.holds(value) ? "" : fmt::format("{}: expected {}", text, range.text());
  };
  return {check, ""};
}

std::string parse_error_text(const CLI::App& cli, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    return unexpected_text(cli);
  }
  const std::string what = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return missing_text(cli, what);
  }
  // "--reject: 2: expected 0 to 1": the option and its value belong together.
  if (const std::size_t colon = what.find(": "); what.find(": expected ", colon + 1) != std::string::npos) {
    return what.substr(0, colon) + " " + what.substr(colon + 2);
  }
  return fmt::format("{} ({})", what, hint(cli));
}

}  // namespace spincat::app
