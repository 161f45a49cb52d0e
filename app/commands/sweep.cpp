#include "spincat/evaluate/sweep.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/evaluate_options.h"
#include "app/options.h"
#include "app/ranks/farm_run.h"
#include "app/terminal/command_line.h"
#include "app/terminal/progress_bar.h"
#include "app/terminal/terminal.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/report/report.h"
#include "spincat/report/sweep_report.h"

namespace spincat::app {
namespace {

struct SweepArguments {
  DatasetArguments dataset;
  std::vector<std::string> vary;
  std::filesystem::path output;
  std::filesystem::path report;
  TestArguments tested;
  EvaluateOptions options;
  SettingsArguments settings;
  RunOptions run;
};

// "bin_size=0.02,0.05,0.1".
Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  Variation variation{text.substr(0, equals), {}};
  for (std::size_t begin = equals; begin != std::string::npos && begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin + 1), text.size());
    variation.values.push_back(text.substr(begin + 1, end - begin - 1));
    begin = end;
  }
  const bool empty = std::ranges::any_of(variation.values, [](const auto& value) { return value.empty(); });
  if (variation.setting.empty() || variation.values.empty() || empty) {
    throw InputError(fmt::format("--vary {}: expected a setting and its values, as in bin_size=0.02,0.05,0.1", text));
  }
  return variation;
}

void check_output(const std::filesystem::path& output) {
  if (output.empty()) {
    return;
  }
  if (output.extension() != ".json" && output.extension() != ".csv") {
    throw InputError(output.string(), "expected a name that ends in .json or .csv");
  }
  check_writable(output);  // before the work, not after it
}

int run_sweep(const SweepArguments& arguments, TaskFarm& farm) {
  const SettingChoices settings = arguments.settings.choices();
  EvaluateOptions options = arguments.options;
  options.test = arguments.tested.options();
  FarmRun run(farm, arguments.run);  // a sweep keeps a journal of its own
  std::vector<Variation> variations;
  for (const std::string& text : arguments.vary) {
    variations.push_back(parse_variation(text));
  }
  check_output(arguments.output);
  check_report(arguments.report);
  const Dataset dataset = arguments.dataset.read();
  std::filesystem::path journal;
  if (!arguments.output.empty()) {
    journal = arguments.output;
    journal += ".journal";
  }
  Sweep found;
  {
    ProgressBar bar(arguments.run);
    Execution execution = run.execution(bar.callback());
    execution.strict = arguments.dataset.strict;
    execution.limits = arguments.dataset.options.limits;
    found = sweep(dataset, settings, variations, options, execution, journal);
  }
  const std::string json = sweep_json(found, found.settings, options, command_line()) + "\n";
  if (!arguments.output.empty()) {
    write_file_atomically(arguments.output, arguments.output.extension() == ".csv" ? sweep_csv(found) : json);
  }
  if (!arguments.report.empty()) {
    write_file_atomically(arguments.report, sweep_page(found, found.settings, options, command_line()));
  }
  run.finish();
  fmt::print("{}", arguments.run.json ? json : sweep_text(found, terminal_width(STDOUT_FILENO, kPipeWidth)));
  return 0;
}

}  // namespace

Command add_sweep(CLI::App& parent) {
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App* command = parent.add_subcommand("sweep", "Measure what a setting does to rate and time");
  command->footer(
      "Example:\n"
      "  spincat sweep furniture/ --vary bin_size=0.02,0.05,0.1 -o bins.csv\n"
      "  spincat sweep furniture/ --vary spin_points=64,128 --vary c=3,30,300\n"
      "Settings have the names of their options (spincat settings lists them). An interrupted sweep with -o goes on "
      "where it stopped when it "
      "is\nasked for again: FILE.journal knows what is done.");
  arguments->dataset.add_to(*command);
  command->add_option("--vary", arguments->vary, "A setting and its values; give it once or twice")
      ->type_name("SETTING=A,B,...")
      ->allow_extra_args(false)
      ->required();
  command->add_option("-o,--output", arguments->output, "A .json or .csv file for the result")->type_name("FILE");
  add_report_option(*command, arguments->report);
  add_split_options(*command, arguments->options);
  command->add_flag("--leave-one-out", arguments->options.leave_one_out,
                    "Test each object by judges that learned from all others");
  arguments->tested.add_to(*command);
  arguments->settings.add_to(*command);
  arguments->run.add_to(*command);
  return [arguments](TaskFarm& farm) { return run_sweep(*arguments, farm); };
}

}  // namespace spincat::app
