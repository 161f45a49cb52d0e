#include "spincat/pipeline/classify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "commands.h"
#include "farm_run.h"
#include "messages.h"
#include "options.h"
#include "progress_bar.h"
#include "spincat/dataset/object_files.h"
#include "spincat/error.h"
#include "spincat/pipeline/classify_tasks.h"
#include "spincat/report/json.h"
#include "spincat/report/text.h"
#include "spincat/report/text_table.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

struct ClassifyArguments {
  fs::path model;
  std::vector<fs::path> inputs;
  bool votes = false;
  double reject = 0.0;  // names of less confidence are not given
  RunOptions run;

  bool rejects(const Classification& c) const { return c.confidence < reject; }
};

// A file to be named, or what is wrong with a folder that should have held some.
struct Input {
  fs::path file;
  std::string problem;
};

// All object files below a folder, sorted; an input with a problem where there is none or it cannot be read.
std::vector<Input> files_below(const fs::path& folder) {
  std::vector<Input> files;
  std::error_code error;
  for (const fs::path& file : object_files_below(folder, error)) {
    files.push_back({file, {}});
  }
  if (error) {
    files.push_back({folder, "a folder in it cannot be read: " + error.message()});
  } else if (files.empty()) {
    files.push_back({folder, "holds no object files"});
  }
  return files;
}

// Files as they are; folders stand for all object files below them.
std::vector<Input> expand_folders(const std::vector<fs::path>& arguments) {
  std::vector<Input> inputs;
  for (const fs::path& argument : arguments) {
    std::error_code error;
    if (fs::is_directory(argument, error)) {
      const std::vector<Input> below = files_below(argument);
      inputs.insert(inputs.end(), below.begin(), below.end());
    } else {
      inputs.push_back({argument, {}});
    }
  }
  return inputs;
}

// Prints answers as people or programs want them. Columns are as wide as the widest file and category.
class AnswerPrinter {
 public:
  AnswerPrinter(const Model& model, const std::vector<Input>& files, const ClassifyArguments& arguments)
      : model_(model), arguments_(arguments) {
    constexpr std::size_t kWidestFile = 48;
    for (const Input& input : files) {
      file_width_ = std::max(file_width_, std::min(kWidestFile, text_width(printable(input.file.string()))));
    }
    if (arguments.reject > 0.0) {
      category_width_ = text_width("unknown");
    }
    for (const std::string& category : model.categories) {
      category_width_ = std::max(category_width_, text_width(printable(category)));
    }
  }

  void print(const fs::path& file, const Answer& answer) {
    if (!answer.classification) {
      print_error(file, answer.error);
    } else if (arguments_.run.json) {
      fmt::print("{}\n", classification_json(file.string(), *answer.classification, model_, arguments_.votes,
                                             arguments_.rejects(*answer.classification)));
    } else {
      print_text(file, *answer.classification);
    }
  }

 private:
  void print_error(const fs::path& file, const std::string& error) {
    if (arguments_.run.json) {
      fmt::print("{}\n", error_json(file.string(), error));
    } else {
      std::fflush(stdout);  // keeps both streams in order where they meet
      message(error);
    }
  }

  void print_text(const fs::path& file, const Classification& c) {
    const StageSeconds& s = c.seconds;
    if (!head_printed_) {  // not before there is a row: a run of errors alone needs none
      print_row("file", "category", "confidence", "votes", "runner-up", "time");
      head_printed_ = true;
    }
    print_row(cut_in_the_middle(printable(file.string()), file_width_),
              arguments_.rejects(c) ? "unknown" : name(c.ballot.winner), fmt::format("{:.2f}", c.confidence),
              fmt::format("{}/{}", c.ballot.count[c.ballot.winner], model_.categories.size() - 1),
              name(c.ballot.runner_up), human_seconds(s.read + s.prepare + s.spin + s.encode + s.judge));
    if (arguments_.rejects(c)) {
      fmt::print("    not confident enough for {}\n", name(c.ballot.winner));
    }
    if (arguments_.votes) {
      fmt::print("{}", ballot_text(c.ballot, model_.categories));
    }
  }

  void print_row(const std::string& file, const std::string& category, const std::string& confidence,
                 const std::string& votes, const std::string& runner_up, const std::string& time) const {
    fmt::print("{}  {}  {:>10}  {:>5}  {}  {:>8}\n", padded(file, file_width_), padded(category, category_width_ + 1),
               confidence, votes, padded(runner_up, std::max<std::size_t>(category_width_, 9)), time);
  }

  std::string name(std::uint32_t category) const { return printable(model_.categories[category]); }

  static std::string padded(const std::string& text, std::size_t width) {
    return text + std::string(width > text_width(text) ? width - text_width(text) : 0, ' ');
  }

  const Model& model_;
  const ClassifyArguments& arguments_;
  std::size_t file_width_ = 4;
  std::size_t category_width_ = 8;
  bool head_printed_ = false;
};

// A folder without objects has no file to be named, but an answer all the same.
Answer problem_of(const Input& input) {
  return {{}, input.file.string() + ": " + input.problem};
}

// Classifies on all threads and ranks and prints in the order of the inputs, each as soon as those before it are
// printed. Returns how many could not be classified.
std::size_t classify_all(const Model& model, const std::vector<Input>& inputs, const ClassifyArguments& arguments,
                         TaskFarm& farm) {
  AnswerPrinter printer(model, inputs, arguments);
  ProgressBar bar(arguments.run);
  std::size_t printed = 0;
  std::size_t failed = 0;
  const auto print = [&](const Answer& answer) {
    failed += answer.classification ? 0 : 1;
    bar.wipe();
    printer.print(inputs[printed++].file, answer);
  };
  const auto print_problems = [&] {  // of inputs that come before the next file
    while (printed < inputs.size() && !inputs[printed].problem.empty()) {
      print(problem_of(inputs[printed]));
    }
  };
  std::vector<const fs::path*> files;
  for (const Input& input : inputs) {
    if (input.problem.empty()) {
      files.push_back(&input.file);
    }
  }
  const ClassifyJob job{model, arguments.model, files.size(),
                        [&](std::size_t i) -> const fs::path& { return *files[i]; }, arguments.run.division()};
  const auto deliver = [&](std::size_t, const Answer& answer) {
    print_problems();
    print(answer);
  };
  classify_files(farm, job, deliver, [&](std::size_t) { bar.update("naming objects", printed, inputs.size()); });
  print_problems();
  return failed;
}

RunIdentity identity_of(const Model& model, const std::vector<Input>& inputs, const ClassifyArguments& arguments) {
  FilesIdentity data;
  data.add(arguments.model);
  for (const Input& input : inputs) {
    data.add(input.file);
  }
  return {settings_identity("classify", model.settings), data.text()};
}

int run_classify(const ClassifyArguments& arguments, TaskFarm& farm) {
  const Model model = read_model(arguments.model);
  const std::vector<Input> files = expand_folders(arguments.inputs);
  FarmRun run(farm, arguments.run);
  run.keep_journal({}, [&] { return identity_of(model, files, arguments); });
  const std::size_t failed = classify_all(model, files, arguments, farm);
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
      "  spincat classify furniture.spincat incoming/ --reject 0.5 --json > names.jsonl");
  command->add_option("model", arguments->model, "A model file written by spincat train")
      ->type_name("MODEL")
      ->required();
  command->add_option("files", arguments->inputs, "Objects, or folders of objects")->type_name("FILE")->required();
  command
      ->add_option("--reject", arguments->reject,
                   "Answer 'unknown' where the confidence is below this: for objects of none of the categories")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("P");
  command->add_flag("--votes", arguments->votes, "Show what every judge said");
  arguments->run.add_to(*command);
  arguments->run.add_farm_options_to(*command);
  return [arguments](TaskFarm& farm) { return run_classify(*arguments, farm); };
}

}  // namespace spincat::app
