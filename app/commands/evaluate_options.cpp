#include "app/commands/evaluate_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "app/terminal/messages.h"
#include "app/terminal/parse_errors.h"
#include "spincat/dataset/splits.h"
#include "spincat/error.h"

namespace spincat::app {
namespace {

constexpr std::uint64_t kMostSeeds = 1'000;

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// Both ends of "5-7" or "5".
std::optional<std::pair<std::uint64_t, std::uint64_t>> parse_range(std::string_view text) {
  const std::size_t dash = text.find('-');
  const auto first = whole_number(text.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : whole_number(text.substr(dash + 1));
  if (!first || !last || *last < *first || *last - *first >= kMostSeeds) {
    return std::nullopt;
  }
  return std::pair(*first, *last);
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(std::string_view option, std::string_view text) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto range = parse_range(text.substr(begin, end - begin));
    if (!range) {
      throw InputError(fmt::format("{} {}: expected whole numbers or ranges of them, as in 1,2,5-7", option, text));
    }
    for (std::uint64_t i = 0; i <= range->second - range->first; ++i) {
      seeds.push_back(range->first + i);
    }
    begin = end + 1;
  }
  std::vector<std::uint64_t> sorted = seeds;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end() || seeds.size() > kMostSeeds) {
    throw InputError(fmt::format("{} {}: expected up to {} numbers, each once", option, text, kMostSeeds));
  }
  return seeds;
}

void add_split_options(CLI::App& command, EvaluateOptions& options) {
  command.add_option("--splits", options.splits, "Random splits into training and test objects, for each seed")
      ->check(in_range({1, kMostSplits}))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--split-seeds",
          [&options](const std::string& text) { options.split_seeds = parse_seeds("--split-seeds", text); },
          "Seeds of the splits, as 1-4 or 1,2,7; objects are described once, by --seed (default: that one)")
      ->type_name("SEEDS");
  command.add_option("--test-share", options.test_share, "Share of each category that is tested on")
      ->check([](const std::string& text) {  // CLI11's ranges include their ends
        double share = 0.0;
        return CLI::detail::lexical_cast(text, share) && share > 0.0 && share < 1.0
                   ? std::string()
                   : text + ": expected more than 0 and less than 1";
      })
      ->type_name("SHARE")
      ->capture_default_str();
  command.add_option("--min-objects", options.fewest_objects, "Leave out categories with fewer objects to learn from")
      ->check(in_range({1, 1'000'000}))
      ->type_name("N")
      ->capture_default_str();
}

void TestArguments::add_to(CLI::App& command) {
  const std::string group = "Form of the tested objects";
  command
      .add_option("--test-as", form,
                  "as-is; turned (at random); cloud (points drawn from the surface, with noise, without normals); "
                  "noisy-mesh (vertices moved); dense-mesh (8,000 triangles, vertices moved); holes (a fifth of the "
                  "area missing); inner (boxes and plates inside); cut (a cloud of which 30 % are missing); sparse (a "
                  "cloud of 300 points)")
      ->group(group)
      ->type_name("FORM")
      ->capture_default_str();
  command
      .add_option("--noise", given.noise,
                  "Noise of test clouds and moved vertices: standard deviation along each axis, in diameters (default: "
                  "0.01; noisy-mesh 0.005; cut and sparse 0)")
      ->check(in_range({0.0, 1.0}))
      ->group(group)
      ->type_name("SHARE");
  command.add_option("--cloud-points", given.cloud_points, "Points of each test cloud (default: 2048; sparse 300)")
      ->check(in_range({1, 10'000'000}))
      ->group(group)
      ->type_name("N");
}

TestOptions TestArguments::options() const {
  TestOptions options = given;
  try {
    options.form = test_form_named(form);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--test-as: {}", error.what()));
  }
  return options;
}

void report_left_out(const std::vector<LeftOutCategory>& left_out, const RunOptions& run) {
  constexpr std::size_t kMostLines = 20;
  for (std::size_t i = 0; !run.quiet && i < left_out.size() && i < kMostLines; ++i) {
    message(fmt::format("category '{}' {}: left out", left_out[i].name, left_out[i].reason));
  }
  if (!run.quiet && left_out.size() > kMostLines) {
    message(fmt::format("{} more categories are left out (--json lists them all)", left_out.size() - kMostLines));
  }
}

}  // namespace spincat::app
