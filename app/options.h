// Options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/execution.h"
#include "spincat/io/read_limits.h"
#include "spincat/settings/settings.h"

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

// A preset and what the user wants different from it.
struct SettingsArguments {
  std::string preset = "default";
  std::optional<std::uint64_t> seed;
  std::optional<int> points;
  std::optional<int> spin_points;
  std::optional<int> image_width;
  std::optional<std::string> bin_size;  // "0.1", "2res", "0.05rel", "3.5abs"
  std::optional<double> support_angle;
  std::optional<std::string> surface;
  std::optional<std::string> encoding;
  std::optional<std::string> up;
  std::optional<std::string> trained_for;
  std::optional<int> draws;
  std::optional<int> words;
  std::optional<std::string> kernel;
  std::optional<double> c;
  std::optional<int> copies;
  std::optional<int> views;

  void add_to(CLI::App& command);
  // Only those that decide about the spin images: no preset, nothing of encodings and judges.
  void add_spin_options_to(CLI::App& command);
  // The preset with what the user wants different. Throws InputError naming what is out of range.
  Settings settings() const;
  Settings applied_to(Settings settings) const;
};

// --report FILE.html.
void add_report_option(CLI::App& command, std::filesystem::path& report);

// Refuses a report that could not be written, before the work and not after it. Throws InputError.
void check_report(const std::filesystem::path& report);

// Tells on standard error which objects were left out and why, in a few lines however many there are.
void report_skipped(const std::vector<SkippedObject>& skipped, const RunOptions& run);

}  // namespace spincat::app
