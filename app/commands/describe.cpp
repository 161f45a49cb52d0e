#include "spincat/describe/describe.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/input_files.h"
#include "app/options.h"
#include "app/ranks/farm_run.h"
#include "app/terminal/messages.h"
#include "app/terminal/progress_bar.h"
#include "spincat/describe/describe_tasks.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/output_file.h"
#include "spincat/files/paths.h"
#include "spincat/io/npy.h"
#include "spincat/report/csv_field.h"
#include "spincat/report/json.h"
#include "spincat/report/text_table.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

struct DescribeArguments {
  std::vector<fs::path> inputs;
  fs::path output;
  SettingsArguments settings;
  ReadLimits limits;
  RunOptions run;
};

// Feature vectors of one length, one behind the other, and which objects they are of.
struct Features {
  std::size_t length = 0;
  std::vector<float> values;
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  std::vector<SkippedObject> left_out;

  void add(const fs::path& file, const Described& described, std::span<const FeatureBytes> values_of) {
    if (values_of.empty()) {
      left_out.push_back({file, described.problem});
      return;
    }
    const std::size_t found = values_of[0].length();
    if (!names.empty() && found != length) {
      left_out.push_back({file, fmt::format("gives {} features where others give {}", found, length)});
      return;
    }
    length = found;
    values.resize(values.size() + length);
    std::ranges::copy(values_of[0].bytes, reinterpret_cast<char*>(values.data() + values.size() - length));
    names.push_back(file.string());
    kinds.emplace_back(described.kind == ObjectKind::mesh ? "mesh" : "cloud");
  }
};

fs::path names_beside(fs::path output) {
  return output.replace_extension(".csv");
}

// Before the work, not after it.
void check_outputs(const fs::path& output) {
  if (lower_extension(output) != ".npy") {
    throw InputError(output.string(), "expected a name that ends in .npy");
  }
  check_writable(output);
  check_writable(names_beside(output));
}

Features describe_all(const std::vector<InputFile>& inputs, const Settings& settings,
                      const DescribeArguments& arguments, TaskFarm& farm) {
  Features features;
  std::vector<const fs::path*> files;
  for (const InputFile& input : inputs) {
    if (input.problem.empty()) {
      files.push_back(&input.file);
    } else {
      features.left_out.push_back({input.file, input.problem});
    }
  }
  ProgressBar bar(arguments.run);
  const DescribeJob job{files.size(),
                        [&](std::size_t i) -> const fs::path& { return *files[i]; },
                        settings,
                        1,
                        arguments.run.split(),
                        arguments.limits,
                        {}};
  describe_files(
      farm, job,
      [&](std::size_t i, const Described& described, std::span<const FeatureBytes> values) {
        features.add(*files[i], described, values);
      },
      [&](std::size_t done) { bar.update("describing objects", done, files.size()); });
  return features;
}

void write_features(const fs::path& output, const Features& features) {
  OutputFile out(output);
  out.write(npy_header(std::array{features.names.size(), features.length}));
  out.write({reinterpret_cast<const char*>(features.values.data()), features.values.size() * sizeof(float)});
  std::string names = "row,path,kind\n";
  for (std::size_t i = 0; i < features.names.size(); ++i) {
    names += fmt::format("{},{},{}\n", i, csv_field(features.names[i]), features.kinds[i]);
  }
  write_file_atomically(names_beside(output), names);
  out.commit();
}

int run_describe(const DescribeArguments& arguments, TaskFarm& farm) {
  const Settings settings = arguments.settings.settings();
  check_outputs(arguments.output);
  const std::vector<InputFile> inputs = input_files(arguments.inputs);
  FarmRun run(farm, arguments.run);
  run.keep_journal(arguments.output, [&] {
    FilesIdentity data;
    for (const InputFile& input : inputs) {
      data.add(input.file);
    }
    return RunIdentity{settings_identity("describe", settings, limits_text(arguments.limits)), data.text()};
  });
  const Features features = describe_all(inputs, settings, arguments, farm);
  report_skipped(features.left_out, arguments.run);
  if (features.names.empty()) {
    throw InputError("no object could be described");
  }
  write_features(arguments.output, features);
  run.finish();
  if (arguments.run.json) {
    fmt::print("{}\n", features_json(arguments.output.string(), features.names.size(), features.length, settings,
                                     features.left_out));
  } else {
    fmt::print("wrote {}: {} objects, {} features each; their names are in {}\n", printable(arguments.output.string()),
               features.names.size(), features.length, printable(names_beside(arguments.output).string()));
  }
  return features.left_out.empty() ? 0 : 2;
}

}  // namespace

Command add_describe(CLI::App& parent) {
  auto arguments = std::make_shared<DescribeArguments>();
  CLI::App* command = parent.add_subcommand("describe", "Write the feature vectors of objects, for other tools");
  command->footer(
      "Example:\n"
      "  spincat describe chairs/ lamp.obj -o features.npy\n"
      "features.npy has a row of 32-bit floats for each object that can be read, as numpy.load reads them; "
      "features.csv "
      "says\nwhich. They are what classify and train see of an object by the same settings.");
  command->add_option("files", arguments->inputs, "Objects, or folders of objects")->type_name("FILE")->required();
  command
      ->add_option("-o,--output", arguments->output, "A .npy file (objects x features); a .csv of names goes beside it")
      ->type_name("FILE")
      ->required();
  arguments->settings.add_to(*command, SettingStage::features);
  add_limit_options(*command, arguments->limits);
  arguments->run.add_to(*command);
  arguments->run.add_farm_options_to(*command);
  return [arguments](TaskFarm& farm) { return run_describe(*arguments, farm); };
}

}  // namespace spincat::app
