// Options of measuring, which evaluate and sweep share.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "spincat/dataset/parts.h"
#include "spincat/evaluate/evaluate.h"

namespace CLI {
class App;
}

namespace spincat::app {

// --splits, --split-seeds, --test-share and --min-objects.
void add_split_options(CLI::App& command, EvaluateOptions& options);

// In which form objects are tested.
struct TestArguments {
  std::string form = "as-is";
  TestOptions given;

  void add_to(CLI::App& command);
  // Throws InputError when there is no such form.
  TestOptions options() const;
};

// "1,2,5-7" as 1, 2, 5, 6, 7. Throws InputError, naming `option`, when it is malformed, names one twice or more than
// 1,000.
std::vector<std::uint64_t> parse_seeds(std::string_view option, std::string_view text);

// Tells on standard error which categories take no part and why.
void report_left_out(const std::vector<LeftOutCategory>& left_out, const RunOptions& run);

}  // namespace spincat::app
