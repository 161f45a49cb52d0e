#include "spincat/pipeline/evaluate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "commands.h"
#include "options.h"
#include "progress_bar.h"
#include "spincat/report/json.h"
#include "spincat/report/text.h"
#include "terminal.h"

namespace spincat::app {
namespace {

constexpr std::size_t kPipeWidth = 160;  // a pipe is taken to be wide

struct EvaluateArguments {
  DatasetArguments dataset;
  SettingsArguments settings;
  EvaluateOptions options;
  RunOptions run;
};

int run_evaluate(const EvaluateArguments& arguments) {
  const Settings settings = arguments.settings.settings();
  EvaluateOptions options = arguments.options;
  options.strict = arguments.dataset.strict;
  options.threads = arguments.run.thread_count();
  const Dataset dataset = arguments.dataset.read();
  Evaluation evaluation;
  {
    ProgressBar bar(arguments.run);
    evaluation = evaluate(dataset, settings, options, bar.callback());
  }
  report_skipped(evaluation.skipped, arguments.run);
  if (arguments.run.json) {
    fmt::print("{}\n", evaluation_json(evaluation, settings));
  } else {
    fmt::print("{}", evaluation_text(evaluation, terminal_width(STDOUT_FILENO, kPipeWidth)));
  }
  return 0;
}

}  // namespace

Command add_evaluate(CLI::App& parent) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command =
      parent.add_subcommand("evaluate", "Measure on repeated stratified splits how often the names are right");
  command->footer(
      "Example:\n"
      "  spincat evaluate furniture/ --splits 20\n"
      "  spincat evaluate psb/ --map data/psb-furniture.csv --preset paper --json");
  arguments->dataset.add_to(*command);
  command->add_option("--splits", arguments->options.splits, "Random splits into training and test objects")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--test", arguments->options.test_fraction, "Share of each category that is tested on")
      ->type_name("SHARE")
      ->capture_default_str();
  arguments->settings.add_to(*command);
  arguments->run.add_to(*command);
  return [arguments] { return run_evaluate(*arguments); };
}

}  // namespace spincat::app
