// What CLI11 finds wrong with a command line, in our words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "spincat/range.h"

namespace spincat::app {

// For an option whose value is a number: refuses others, and those out of the range, as "VALUE: expected RANGE".
CLI::Validator in_range(const Range& range);

// One line: what is wrong, which option of the subcommand may have been meant, and whose --help tells more.
std::string parse_error_text(const CLI::App& cli, const CLI::ParseError& error);

}  // namespace spincat::app
