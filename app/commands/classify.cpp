#include "spincat/classify/classify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/classify_report.h"
#include "app/commands/commands.h"
#include "app/commands/input_files.h"
#include "app/options.h"
#include "app/ranks/farm_run.h"
#include "app/terminal/answer_printer.h"
#include "app/terminal/messages.h"
#include "app/terminal/parse_errors.h"
#include "app/terminal/progress_bar.h"
#include "spincat/error.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

struct ClassifyArguments {
  fs::path model;
  std::vector<fs::path> inputs;
  AnswerLook look;
  fs::path report;
  ReadLimits limits;
  RunOptions run;
};

// Objects of a kind that the judges were not trained for: each has a * in the table; why is told once.
struct KindMismatches {
  std::size_t count = 0;
  std::string first;

  void add(const fs::path& file, const Answer& answer) {
    if (answer.classification && !answer.classification->kind_mismatch.empty() && count++ == 0) {
      first = file.string() + ": " + answer.classification->kind_mismatch;
    }
  }

  void tell() const {
    if (count > 0) {
      std::fflush(stdout);
      message(first + (count > 1 ? fmt::format(" (and {} more)", count - 1) : ""));
    }
  }
};

// A folder without objects has no file to be named, but an answer all the same.
Answer problem_of(const InputFile& input) {
  return {{}, input.file.string() + ": " + input.problem};
}

// Classifies on all threads and ranks and prints in the order of the inputs, each as soon as those before it are
// printed. Returns what became of each, where a report wants it, and how many could not be classified.
struct Classified {
  std::vector<NamedFile> named;
  std::size_t failed = 0;
};

Classified classify_all(const Model& model, const std::vector<InputFile>& inputs, const ClassifyArguments& arguments,
                        const FarmRun& run) {
  std::vector<std::string> names;
  for (const InputFile& input : inputs) {
    names.push_back(input.file.string());
  }
  AnswerLook look = arguments.look;
  look.json = arguments.run.json;
  AnswerPrinter printer(model, names, look);
  ProgressBar bar(arguments.run);
  std::size_t printed = 0;
  Classified result;
  KindMismatches kind_mismatches;
  const auto print = [&](const Answer& answer) {
    kind_mismatches.add(inputs[printed].file, answer);
    result.failed += answer.classification ? 0 : 1;
    bar.wipe();
    printer.print(names[printed], answer);
    if (!arguments.report.empty()) {
      result.named.push_back({inputs[printed].file, answer});
    }
    ++printed;
  };
  const auto print_problems = [&] {  // of inputs that come before the next file
    while (printed < inputs.size() && !inputs[printed].problem.empty()) {
      print(problem_of(inputs[printed]));
    }
  };
  std::vector<fs::path> files;
  for (const InputFile& input : inputs) {
    if (input.problem.empty()) {
      files.push_back(input.file);
    }
  }
  Execution execution = run.execution(
      [&](std::string_view stage, std::size_t, std::size_t) { bar.update(stage, printed, inputs.size()); });
  execution.limits = arguments.limits;
  classify_files(model, files, execution, [&](std::size_t, const Answer& answer) {
    print_problems();
    print(answer);
  });
  print_problems();
  bar.wipe();
  if (!arguments.run.quiet) {
    kind_mismatches.tell();
  }
  return result;
}

RunIdentity batch_identity(const Model& model, const std::vector<InputFile>& inputs,
                           const ClassifyArguments& arguments) {
  FilesIdentity data;
  data.add(arguments.model);
  for (const InputFile& input : inputs) {
    data.add(input.file);
  }
  return {settings_identity("classify", model.settings(), limits_text(arguments.limits)), data.text()};
}

int run_classify(const ClassifyArguments& arguments, TaskFarm& farm) {
  const Model model = read_model(arguments.model);
  const std::vector<InputFile> files = input_files(arguments.inputs);
  FarmRun run(farm, arguments.run);
  run.keep_journal({}, [&] { return batch_identity(model, files, arguments); });
  check_report(arguments.report);
  const auto [named, failed] = classify_all(model, files, arguments, run);
  if (!arguments.report.empty()) {
    write_classify_report(arguments.report, arguments.model, model, named, arguments.look, arguments.limits,
                          arguments.run);
  }
  if (failed > 0 && files.size() > 1 && !arguments.run.quiet) {
    std::fflush(stdout);
    message(fmt::format("{} of {} objects could not be named", failed, files.size()));
  }
  std::fflush(stdout);
  run.finish();
  return failed > 0 ? 2 : 0;
}

}  // namespace

Command add_classify(CLI::App& parent) {
  auto arguments = std::make_shared<ClassifyArguments>();
  CLI::App* command = parent.add_subcommand("classify", "Name objects by a model");
  command->footer(
      "Example:\n"
      "  spincat classify furniture.spincat chair.obj scans/*.ply\n"
      "  spincat classify furniture.spincat incoming/ --json > names.jsonl");
  command->add_option("model", arguments->model, "A model file written by spincat train")
      ->type_name("MODEL")
      ->required();
  command->add_option("files", arguments->inputs, "Objects, or folders of objects")->type_name("FILE")->required();
  command
      ->add_option(
          "--reject", arguments->look.reject,
          "Answer 'unknown' where an object is less known than this (0: name everything; default: the model's choice)")
      ->check(in_range({0.0, 1.0}))
      ->type_name("P");
  command->add_flag("--votes", arguments->look.votes, "Show what every judge said");
  add_report_option(*command, arguments->report);
  add_limit_options(*command, arguments->limits);
  arguments->run.add_to(*command);
  arguments->run.add_farm_options_to(*command);
  return [arguments](TaskFarm& farm) { return run_classify(*arguments, farm); };
}

}  // namespace spincat::app
