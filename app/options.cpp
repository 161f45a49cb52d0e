#include "app/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "app/terminal/messages.h"
#include "app/terminal/parse_errors.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/parallel/for_each.h"

namespace spincat::app {
namespace {

// "(default 256; paper 100)": the first is what holds without --preset.
std::string defaults_text(const Setting& setting, const std::optional<Settings>& own) {
  if (own) {
    return fmt::format("(default {})", setting_text(*own, setting));
  }
  std::string text;
  for (const std::string& name : preset_names()) {
    const std::string value = setting_text(preset(name), setting);
    if (text.empty()) {
      text = "default " + value;
    } else if (value != setting_text(preset(preset_names()[0]), setting)) {
      text += fmt::format("; {} {}", name, value);
    }
  }
  return fmt::format("({})", text);
}

const char* group_of(SettingStage stage) {
  switch (stage) {
    case SettingStage::points:
      return "Settings: points";
    case SettingStage::images:
      return "Settings: spin images";
    case SettingStage::features:
      return "Settings: features";
    case SettingStage::training:
      break;
  }
  return "Settings: training";
}

void add_limit(CLI::App& command, const char* name, std::size_t& limit, std::size_t most, const char* help) {
  command.add_option(name, limit, help)
      ->group("Limits while reading")
      ->check(in_range({1.0, static_cast<double>(most)}))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void RunOptions::add_to(CLI::App& command) {
  command.add_option("--threads", threads, "Threads to use; 0 means one for each processor")
      ->check(in_range({0, 4096}))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--json", json, "Print JSON for programs instead of a table");
  command.add_flag("--quiet", quiet, "No progress and no notes on standard error, only errors");
}

void RunOptions::add_farm_options_to(CLI::App& command) {
  const std::string group = "Many processes (mpirun, srun)";
  command
      .add_option(
          "--journal", journal,
          "Record finished tasks in FILE so that the same command can resume; none turns this off (under mpirun "
          "and srun: OUTPUT.journal)")
      ->group(group)
      ->type_name("FILE");
  command
      .add_option("--divide", divide,
                  "sums: whoever makes spin images encodes them, too; images: they are returned, and the first process "
                  "encodes (the paper's way, for comparison)")
      ->group(group)
      ->check(CLI::IsMember({"sums", "images"}))
      ->type_name("WHAT")
      ->capture_default_str();
}

WorkSplit RunOptions::split() const {
  return divide == "images" ? WorkSplit::return_images : WorkSplit::encode_remotely;
}

void add_report_option(CLI::App& command, std::filesystem::path& report) {
  command.add_option("--report", report, "Also write a page with pictures: one HTML file that needs no network")
      ->type_name("FILE.html");
}

void check_report(const std::filesystem::path& report) {
  if (report.empty()) {
    return;
  }
  if (report.extension() != ".html" && report.extension() != ".htm") {
    throw InputError(report.string(), "expected a name that ends in .html");
  }
  check_writable(report);
}

int RunOptions::thread_count() const {
  return spincat::thread_count(threads);
}

void DatasetArguments::add_to(CLI::App& command, bool required) {
  command
      .add_option("dataset", sources,
                  "A folder with one sub-folder per category, a CSV file with the columns path,category, or Princeton "
                  ".cla files; several are merged")
      ->type_name("DATASET")
      ->required(required);
  command.add_option("--models", options.models, "Where the models are that a CSV or .cla file names")
      ->type_name("FOLDER");
  command
      .add_option("--map", options.category_map,
                  "A CSV file with the columns class,category: keep these classes, under these names")
      ->type_name("FILE");
  command
      .add_option(
          "--others", options.others,
          "Objects of none of the categories, a folder or a CSV file with the column path: what is like them is "
          "a stranger")
      ->type_name("DATA");
  command.add_option("--others-models", options.others_models, "As --models, for --others")->type_name("FOLDER");
  command.add_flag("--strict", strict, "Stop at an object that cannot be read (default: skip it and say so)");
  add_limit_options(command, options.limits);
}

void add_limit_options(CLI::App& command, ReadLimits& limits) {
  add_limit(command, "--max-points", limits.max_points, 4'294'967'295, "Points or vertices of an object");
  add_limit(command, "--max-triangles", limits.max_triangles, 1'000'000'000'000, "Triangles of an object");
  add_growth_option(command, limits);
}

void add_growth_option(CLI::App& command, ReadLimits& limits) {
  add_limit(command, "--max-growth", limits.max_growth, 1'000'000,
            "Bytes of memory for each byte of a file, where it packs or repeats what it holds");
}

std::string limits_text(const ReadLimits& limits) {
  return fmt::format("{} {} {}", limits.max_points, limits.max_triangles, limits.max_growth);
}

void SettingsArguments::add_to(CLI::App& command, SettingStage last) {
  command.add_option("--preset", preset, fmt::format("One of {}", fmt::join(preset_names(), ", ")))
      ->group("Settings")
      ->type_name("NAME")
      ->capture_default_str();
  add_options(command, last);
}

void SettingsArguments::add_to(CLI::App& command, SettingStage last, const Settings& own) {
  own_ = own;
  preset.clear();
  command
      .add_option("--preset", preset,
                  fmt::format("Settings of the classifier instead of this command's own: one of {}",
                              fmt::join(preset_names(), ", ")))
      ->group("Settings")
      ->type_name("NAME");
  add_options(command, last);
}

void SettingsArguments::add_options(CLI::App& command, SettingStage last) {
  for (const Setting& setting : setting_table()) {
    if (setting.stage > last) {
      continue;
    }
    const std::string words = setting_words(setting);
    const std::string help =
        fmt::format("{}{}{} {}", setting.help, words.empty() ? "" : ": ", words, defaults_text(setting, own_));
    const std::string option = fmt::format("--{}", setting.option);
    const auto choose = [this, option, &setting](const std::string& text) {
      chosen.push_back({std::string(setting.name), text, option});
    };
    command.add_option_function<std::string>(option, choose, help)
        ->group(group_of(setting.stage))
        ->type_name(std::string(setting.placeholder));
  }
}

bool SettingsArguments::asks_for(std::string_view setting) const {
  return std::ranges::find(chosen, setting, &ChosenSetting::name) != chosen.end();
}

SettingChoices SettingsArguments::choices() const {
  return {preset.empty() ? own_.value() : spincat::preset(preset), chosen};
}

void report_skipped(const std::vector<SkippedObject>& skipped, const RunOptions& run) {
  constexpr std::size_t kMostLines = 20;
  if (run.quiet) {
    return;
  }
  for (std::size_t i = 0; i < skipped.size() && i < kMostLines; ++i) {
    message(fmt::format("{}: {} (skipped)", skipped[i].file.string(), skipped[i].reason));
  }
  if (skipped.size() > kMostLines) {
    message(fmt::format("{} more were skipped (--json lists them all)", skipped.size() - kMostLines));
  }
}

}  // namespace spincat::app
