#include "spincat/train/train.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/options.h"
#include "app/ranks/farm_run.h"
#include "app/terminal/messages.h"
#include "app/terminal/progress_bar.h"
#include "app/terminal/terminal.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/files/file.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/report/json.h"
#include "spincat/report/report.h"
#include "spincat/report/text.h"

namespace spincat::app {
namespace {

struct TrainArguments {
  DatasetArguments dataset;
  SettingsArguments settings;
  RunOptions run;
  std::filesystem::path output;
  bool all = false;
};

// Without its official test split, unless the user wants that, too.
Dataset dataset_to_learn_from(const TrainArguments& arguments) {
  Dataset whole = arguments.dataset.read();
  if (arguments.all) {
    return whole;
  }
  Dataset part = training_part(whole);
  const std::size_t held_back = whole.objects.size() - part.objects.size();
  if (held_back > 0 && !arguments.run.quiet) {
    message(fmt::format("{} of {} objects are in the data set's test split and held back (--all learns from them, too)",
                        held_back, whole.objects.size()));
  }
  for (const std::string& category : whole.categories) {
    if (!std::ranges::binary_search(part.categories, category)) {
      message(fmt::format("category '{}' has objects in the test split only: it is not learned (--all learns it, too)",
                          category));
    }
  }
  return part;
}

int run_train(const TrainArguments& arguments, TaskFarm& farm) {
  const Settings settings = arguments.settings.settings();
  check_writable(arguments.output);  // before the work, not after it
  const Dataset dataset = dataset_to_learn_from(arguments);
  FarmRun run(farm, arguments.run);
  run.keep_journal(arguments.output, [&] {
    return RunIdentity{settings_identity("train", settings, limits_text(dataset.limits)), identity_of(dataset)};
  });
  Stopwatch watch;
  const TrainResult result = [&] {
    ProgressBar bar(arguments.run);
    Execution execution = run.execution(bar.callback());
    execution.strict = arguments.dataset.strict;
    return train(dataset, settings, execution);
  }();
  write_model(arguments.output, result.model);
  run.finish();
  report_skipped(result.skipped, arguments.run);
  if (arguments.output == "/dev/stdout") {
    return 0;  // the model went there; nothing must follow it
  }
  if (arguments.run.json) {
    fmt::print("{}\n", training_json(arguments.output.string(), result));
  } else {
    fmt::print("{}wrote {} in {}\n", model_text(result.model, terminal_width(STDOUT_FILENO, 0)),
               arguments.output.string(), human_seconds(watch.lap()));
  }
  return 0;
}

}  // namespace

Command add_train(CLI::App& parent) {
  auto arguments = std::make_shared<TrainArguments>();
  CLI::App* command = parent.add_subcommand("train", "Learn from a data set and write a model");
  command->footer(
      "Example:\n"
      "  spincat train furniture/ -o furniture.spincat\n"
      "  spincat train labels.csv --models scans/ -o scans.spincat --seed 7");
  arguments->dataset.add_to(*command);
  command->add_option("-o,--output", arguments->output, "The model file to write")->type_name("FILE")->required();
  command->add_flag("--all", arguments->all, "Learn from the objects of an official test split, too");
  arguments->settings.add_to(*command);
  arguments->run.add_to(*command);
  arguments->run.add_farm_options_to(*command);
  return [arguments](TaskFarm& farm) { return run_train(*arguments, farm); };
}

}  // namespace spincat::app
