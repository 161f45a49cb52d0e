#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "app/options.h"
#include "app/terminal/command_line.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/terminal.h"
#include "spincat/classify/model.h"
#include "spincat/describe/describe.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/io/read_object.h"
#include "spincat/prepare/facts.h"
#include "spincat/report/json.h"
#include "spincat/report/object_page.h"
#include "spincat/report/report.h"
#include "spincat/report/text.h"

namespace spincat::app {
namespace {

struct InfoArguments {
  std::filesystem::path file;
  std::filesystem::path report;
  SettingsArguments settings;
  ReadLimits limits;
  bool json = false;
  bool quiet = false;
};

int run_on_model(const InfoArguments& arguments) {
  if (!arguments.report.empty()) {
    throw InputError(arguments.file.string(), "is a model, and --report shows an object");
  }
  const Model model = read_model(arguments.file);
  fmt::print("{}", arguments.json ? model_json(arguments.file.string(), model) + "\n"
                                  : model_text(model, terminal_width(STDOUT_FILENO, 0)));
  return 0;
}

int run_info(const InfoArguments& arguments) {
  const bool is_model = is_model_file(arguments.file);
  stop_if_interrupted();
  if (is_model) {
    return run_on_model(arguments);
  }
  check_report(arguments.report);
  const std::string name = arguments.file.string();
  const Settings settings = arguments.settings.settings();
  const Object object = read_object(arguments.file, arguments.limits);
  stop_if_interrupted();
  const ObjectFacts facts = facts_of(object);
  stop_if_interrupted();
  if (!arguments.report.empty()) {
    const Preparation prepared = naming_file(name, [&] { return prepare_object(object, settings); });
    stop_if_interrupted();
    write_file_atomically(arguments.report, object_page(name, object, facts, prepared, settings, command_line()));
  }
  fmt::print("{}", arguments.json ? object_json(name, facts) + "\n" : object_text(facts));
  return 0;
}

}  // namespace

Command add_info(CLI::App& parent) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = parent.add_subcommand("info", "Tell what a model or an object file holds");
  command->footer(
      "Example:\n"
      "  spincat info chair.obj --report chair.html\n"
      "  spincat info furniture.spincat --json");
  command->add_option("file", arguments->file, "A model or an object")->type_name("FILE")->required();
  add_report_option(*command, arguments->report);
  command->add_flag("--json", arguments->json, "Print JSON for programs");
  command->add_flag("--quiet", arguments->quiet, "No notes on standard error, only errors");
  arguments->settings.add_to(*command, SettingStage::images);
  add_limit_options(*command, arguments->limits);
  return [arguments](TaskFarm&) { return run_info(*arguments); };
}

}  // namespace spincat::app
