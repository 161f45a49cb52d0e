#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "options.h"
#include "spincat/io/file.h"
#include "spincat/io/read_object.h"
#include "spincat/pipeline/model.h"
#include "spincat/prepare/facts.h"
#include "spincat/report/json.h"
#include "spincat/report/text.h"

namespace spincat::app {
namespace {

struct InfoArguments {
  std::filesystem::path file;
  bool json = false;
};

int run_info(const InfoArguments& arguments) {
  const std::string name = arguments.file.string();
  if (is_model_file(arguments.file)) {
    const Model model = read_model(arguments.file);
    fmt::print("{}", arguments.json ? model_json(name, model) + "\n" : model_text(model));
  } else {
    const ObjectFacts facts = facts_of(read_object(arguments.file));
    fmt::print("{}", arguments.json ? object_json(name, facts) + "\n" : object_text(facts));
  }
  return 0;
}

}  // namespace

Command add_info(CLI::App& parent) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = parent.add_subcommand("info", "Tell what a model or an object file holds");
  command->footer(
      "Example:\n"
      "  spincat info chair.obj\n"
      "  spincat info furniture.spincat --json");
  command->add_option("file", arguments->file, "A model or an object")->type_name("FILE")->required();
  command->add_flag("--json", arguments->json, "Print JSON for programs");
  return [arguments](TaskFarm&) { return run_info(*arguments); };
}

}  // namespace spincat::app
