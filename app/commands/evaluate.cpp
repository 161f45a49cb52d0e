#include "spincat/evaluate/evaluate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/evaluate_options.h"
#include "app/options.h"
#include "app/ranks/farm_run.h"
#include "app/terminal/command_line.h"
#include "app/terminal/messages.h"
#include "app/terminal/progress_bar.h"
#include "app/terminal/terminal.h"
#include "spincat/dataset/object_files.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/report/confusion_picture.h"
#include "spincat/report/json.h"
#include "spincat/report/report.h"
#include "spincat/report/text.h"

namespace spincat::app {
namespace {

struct EvaluateArguments {
  DatasetArguments dataset;
  std::vector<std::filesystem::path> train;
  std::vector<std::filesystem::path> test;
  DatasetOptions test_options;
  bool official = false;
  TestArguments tested;
  std::filesystem::path unknown;
  std::filesystem::path unknown_models;
  EvaluateOptions options;
  std::filesystem::path report;
  SettingsArguments settings;
  RunOptions run;
};

// Exactly one way of choosing what is learned from and what is tested.
void check_protocol(const EvaluateArguments& a) {
  if (a.train.empty() != a.test.empty()) {
    throw InputError(a.train.empty() ? "--test requires --train" : "--train requires --test");
  }
  if (a.dataset.sources.empty() == a.train.empty()) {
    throw InputError("evaluate needs a DATASET, or --train and --test");
  }
  if (int{a.official} + int{a.options.leave_one_out} + int{!a.train.empty()} > 1) {
    throw InputError("--official, --leave-one-out and --train exclude each other");
  }
}

// The objects of both data sets are read alike.
DatasetOptions test_options(const EvaluateArguments& a) {
  DatasetOptions options = a.test_options;
  options.limits = a.dataset.options.limits;
  return options;
}

Evaluation run_protocol(const EvaluateArguments& a, const Settings& settings, const EvaluateOptions& options,
                        const Execution& execution) {
  const DatasetOptions& learn = a.dataset.options;
  if (!a.train.empty()) {
    return evaluate_across(read_dataset(a.train, learn), read_dataset(a.test, test_options(a)), settings, options,
                           execution);
  }
  const Dataset dataset = read_dataset(a.dataset.sources, learn);
  if (a.official) {
    const Dataset test = testing_part(dataset);  // first: it refuses a data set without a split
    return evaluate_across(training_part(dataset), test, settings, options, execution);
  }
  return evaluate(dataset, settings, options, execution);
}

// report.html and ".confusion.png": report.confusion.png.
std::filesystem::path beside(std::filesystem::path report, const char* ending) {
  return report.replace_extension(ending);
}

std::vector<std::filesystem::path> unknown_objects_of(const EvaluateArguments& a) {
  return a.unknown.empty() ? std::vector<std::filesystem::path>() : read_objects(a.unknown, a.unknown_models);
}

// Which files an evaluation works on: its arguments and what lies below them.
std::string data_identity(const EvaluateArguments& a) {
  FilesIdentity data;
  for (const auto* sources : {&a.dataset.sources, &a.train, &a.test}) {
    for (const std::filesystem::path& source : *sources) {
      data.add(source);
    }
    if (!sources->empty()) {
      const DatasetOptions options = sources == &a.test ? test_options(a) : a.dataset.options;
      for (const DatasetObject& object : read_dataset(*sources, options).objects) {
        data.add(object.file);
      }
    }
  }
  for (const std::filesystem::path& file : unknown_objects_of(a)) {
    data.add(file);
  }
  if (!a.dataset.options.others.empty()) {
    data.add(a.dataset.options.others);
    for (const std::filesystem::path& file : read_objects(a.dataset.options.others, a.dataset.options.others_models)) {
      data.add(file);
    }
  }
  return data.text();
}

int run_evaluate(const EvaluateArguments& arguments, TaskFarm& farm) {
  check_protocol(arguments);
  const Settings settings = arguments.settings.settings();
  EvaluateOptions options = arguments.options;
  options.test = arguments.tested.options();
  FarmRun run(farm, arguments.run);
  run.keep_journal({}, [&] {
    const TestOptions& test = options.test;
    const std::string shown = fmt::format("{} {} {} {}", name_of(test.form), test.used_noise(),
                                          test.used_cloud_points(), limits_text(arguments.dataset.options.limits));
    return RunIdentity{settings_identity("evaluate", settings, shown), data_identity(arguments)};
  });
  options.unknown_objects = unknown_objects_of(arguments);
  check_report(arguments.report);
  if (!arguments.report.empty()) {
    check_writable(beside(arguments.report, ".confusion.svg"));
    check_writable(beside(arguments.report, ".confusion.png"));
  }
  Evaluation evaluation;
  {
    ProgressBar bar(arguments.run);
    Execution execution = run.execution(bar.callback());
    execution.strict = arguments.dataset.strict;
    execution.limits = arguments.dataset.options.limits;
    evaluation = run_protocol(arguments, settings, options, execution);
  }
  report_left_out(evaluation.left_out, arguments.run);
  report_skipped(evaluation.skipped, arguments.run);
  if (!evaluation.kind_mismatch.empty() && !arguments.run.quiet) {
    message("what is tested " + evaluation.kind_mismatch);
  }
  if (arguments.run.json) {
    fmt::print("{}\n", evaluation_json(evaluation, settings, options, command_line()));
  } else {
    fmt::print("{}",
               evaluation_text(evaluation, terminal_width(STDOUT_FILENO, kPipeWidth), shows_colours(STDOUT_FILENO)));
  }
  std::fflush(stdout);
  if (!arguments.report.empty()) {  // after the numbers: a full disk must not cost them
    write_file_atomically(arguments.report, evaluation_page(evaluation, settings, options, command_line()));
    const std::string picture = confusion_svg(evaluation);
    write_file_atomically(beside(arguments.report, ".confusion.svg"), picture);
    write_file_atomically(beside(arguments.report, ".confusion.png"), png_of_svg(picture));
  }
  run.finish();
  return 0;
}

void add_across_options(CLI::App& command, EvaluateArguments& a) {
  const std::string group = "Two data sets";
  command.add_option("--train", a.train, "Learn from this data set (--models and --map are for it) ...")
      ->group(group)
      ->type_name("DATASET");
  command
      .add_option("--test", a.test,
                  "... and test on that one, on the categories of the same names; the others are left out")
      ->group(group)
      ->type_name("DATASET");
  command.add_option("--test-models", a.test_options.models, "As --models, for --test")
      ->group(group)
      ->type_name("FOLDER");
  command.add_option("--test-map", a.test_options.category_map, "As --map, for --test")
      ->group(group)
      ->type_name("FILE");
}

void add_confidence_options(CLI::App& command, EvaluateArguments& a) {
  const std::string group = "Confidence";
  command
      .add_flag("--confidence", a.options.measure_confidence,
                "Measure how well the confidence tells right from wrong names (takes six times as long)")
      ->group(group);
  command
      .add_option("--unknown", a.unknown,
                  "Objects of none of the categories, a CSV file with the column path or a folder: measure how well "
                  "the confidence tells known from unknown objects, too")
      ->group(group)
      ->type_name("DATA");
  command.add_option("--unknown-models", a.unknown_models, "As --models, for --unknown")
      ->group(group)
      ->type_name("FOLDER");
}

}  // namespace

Command add_evaluate(CLI::App& parent) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = parent.add_subcommand("evaluate", "Measure how often the names are right");
  command->footer(
      "Example:\n"
      "  spincat evaluate furniture/ --splits 40 --split-seeds 1-4\n"
      "  spincat evaluate psb/ --map data/psb-furniture.csv --leave-one-out --json\n"
      "  spincat evaluate --train psb/ --map data/psb-furniture.csv --test furniture/\n"
      "Without --leave-one-out, --official or --train there are repeated random splits, stratified by category.\n"
      "The rate of a category is also called its recall, the mean-class rate balanced accuracy, the overall rate "
      "accuracy.");
  arguments->dataset.add_to(*command, false);
  add_split_options(*command, arguments->options);
  command->add_flag("--leave-one-out", arguments->options.leave_one_out,
                    "Test each object by judges that learned from all others");
  command->add_flag("--official", arguments->official,
                    "Use the data set's own split: learn from train, test on test (val is left out)");
  add_across_options(*command, *arguments);
  arguments->tested.add_to(*command);
  add_confidence_options(*command, *arguments);
  add_report_option(*command, arguments->report);
  arguments->settings.add_to(*command);
  arguments->run.add_to(*command);
  arguments->run.add_farm_options_to(*command);
  return [arguments](TaskFarm& farm) { return run_evaluate(*arguments, farm); };
}

}  // namespace spincat::app
