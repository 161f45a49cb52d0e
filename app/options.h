// Options that several subcommands share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/execution.h"
#include "spincat/io/read_limits.h"
#include "spincat/settings/setting_table.h"

namespace CLI {
class App;
}

namespace spincat::app {

// How to run and how to answer: nothing here changes a result.
struct RunOptions {
  int threads = 0;
  bool json = false;
  bool quiet = false;
  std::optional<std::filesystem::path> journal;  // empty path: none
  std::string divide = "sums";

  void add_to(CLI::App& command);
  // For commands whose work is shared out to other ranks.
  void add_farm_options_to(CLI::App& command);
  int thread_count() const;
  WorkSplit split() const;
};

// What to learn from.
struct DatasetArguments {
  std::vector<std::filesystem::path> sources;
  DatasetOptions options;
  bool strict = false;

  void add_to(CLI::App& command, bool required = true);
  Dataset read() const { return read_dataset(sources, options); }
};

// How large an object may be: what read_object refuses otherwise.
void add_limit_options(CLI::App& command, ReadLimits& limits);

// The same for frames, whose files hold one picture each.
void add_growth_option(CLI::App& command, ReadLimits& limits);

// The limits as text, for the identity of a journal.
std::string limits_text(const ReadLimits& limits);

// A preset and what the user wants different from it: an option for every setting of the table.
struct SettingsArguments {
  std::string preset = "default";
  std::vector<ChosenSetting> chosen;

  // --preset and the options of all settings up to this stage.
  void add_to(CLI::App& command, SettingStage last = SettingStage::training);
  // The same for a command whose settings are `own` unless a preset is asked for.
  void add_to(CLI::App& command, SettingStage last, const Settings& own);

  bool asks_for(std::string_view setting) const;
  SettingChoices choices() const;
  // Throws InputError that begins with the option.
  Settings settings() const { return choices().settings(); }

 private:
  void add_options(CLI::App& command, SettingStage last);

  std::optional<Settings> own_;
};

// --report FILE.html.
void add_report_option(CLI::App& command, std::filesystem::path& report);

// Refuses a report that could not be written, before the work and not after it. Throws InputError.
void check_report(const std::filesystem::path& report);

// Tells on standard error which objects were left out and why, in a few lines however many there are.
void report_skipped(const std::vector<SkippedObject>& skipped, const RunOptions& run);

}  // namespace spincat::app
