#include "app/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <string_view>

#include "app/terminal/messages.h"
#include "spincat/encode/encoding.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/parallel/for_each.h"
#include "spincat/settings/setting_names.h"

namespace spincat::app {
namespace {

struct BinSize {
  double value;
  std::optional<BinSizeUnit> unit;
};

BinSize parse_bin_size(std::string_view text) {
  BinSize size{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size.value);
  const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (unit == "abs") {
    size.unit = BinSizeUnit::absolute;
  } else if (unit == "res") {
    size.unit = BinSizeUnit::resolution;
  } else if (unit == "rel") {
    size.unit = BinSizeUnit::relative;
  }
  if (error != std::errc{} || (!unit.empty() && !size.unit)) {
    throw InputError(
        fmt::format("--bin-size {}: expected a number, maybe followed by abs, res or rel, as in 0.05rel", text));
  }
  return size;
}

template <class T>
void override(T& setting, const std::optional<T>& wanted) {
  if (wanted) {
    setting = *wanted;
  }
}

void add_limit(CLI::App& command, const char* name, std::size_t& limit, std::size_t most, const char* help) {
  command.add_option(name, limit, help)
      ->group("Limits while reading")
      ->check(CLI::Range(std::size_t{1}, most))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void RunOptions::add_to(CLI::App& command) {
  command.add_option("--threads", threads, "Threads to use; 0 means one for each processor")
      ->check(CLI::Range(0, 4096))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--json", json, "Print JSON for programs instead of a table");
  command.add_flag("--quiet", quiet, "No progress and no notes on standard error, only errors");
}

void RunOptions::add_farm_options_to(CLI::App& command) {
  const std::string group = "Many processes (mpirun, srun)";
  command
      .add_option("--journal", journal,
                  "Keep finished tasks in this file, so that the same command goes on where it was ended; none: keep "
                  "none (under mpirun and srun: OUTPUT.journal)")
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
  command.add_flag("--strict", strict, "An object that cannot be read is an error, not left out");
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

void SettingsArguments::add_spin_options_to(CLI::App& command) {
  const auto add = [&](const char* name, auto& variable, const std::string& help, const char* type) {
    command.add_option(name, variable, help)->group("Settings")->type_name(type);
  };
  command.add_option("--seed", seed, "Of every random choice (default 1)")
      ->group("Settings")
      ->type_name("N")
      ->check([](const std::string& text) {  // CLI11 would wrap -1 around
        const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        return whole ? std::string() : "expected a whole number from 0, not " + text;
      });
  add("--surface", surface, "Points that stand for a mesh: vertices, samples or external", "KIND");
  add("--points", points, "Surface points of an object", "N");
  add("--spin-points", spin_points, "Spin points (and images) of an object, chosen at random", "N");
  add("--image-width", image_width, "Rows and columns of a spin image, 1 to 256", "N");
  add("--bin-size", bin_size,
      "Size of a bin: a number followed by rel (object radii), res (mesh resolutions) or abs (the file's unit); "
      "without one, the preset's unit",
      "SIZE");
  add("--support-angle", support_angle, "Largest angle between normals, 0 to 180 degrees", "DEGREES");
}

void SettingsArguments::add_to(CLI::App& command) {
  const std::string group = "Settings";
  command.add_option("--preset", preset, fmt::format("One of {}", fmt::join(preset_names(), ", ")))
      ->group(group)
      ->type_name("NAME")
      ->capture_default_str();
  add_spin_options_to(command);
  command.add_option("--encoding", encoding, fmt::format("One of {}", fmt::join(encoding_names(), ", ")))
      ->group(group)
      ->type_name("NAME");
  command
      .add_option("--for", trained_for,
                  "What is to be named later: meshes, or any: point clouds, too (takes twice the time to learn)")
      ->group(group)
      ->type_name("KIND");
  command
      .add_option("--views", views,
                  "Learn what a depth camera sees: so many rendered views of each training object, for spincat camera "
                  "(30: better, takes longer); their axis that points up is y, or what --up says")
      ->group(group)
      ->type_name("N");
  command.add_option("--up", up, "The axis that points up in all objects: x, y, z or none (default)")
      ->group(group)
      ->type_name("AXIS");
  command.add_option("--draws", draws, "Draws of points that a feature vector is the mean of")
      ->group(group)
      ->type_name("N");
  command.add_option("--words", words, "Words of the codebook that bag-of-features learns")
      ->group(group)
      ->type_name("N");
  command.add_option("--kernel", kernel, "Of the judges' SVMs: linear or rbf (over the encoding's blocks)")
      ->group(group)
      ->type_name("NAME");
  command.add_option("--c", c, "C of the judges' SVMs; without it, the one that suits the kernel")
      ->group(group)
      ->type_name("C");
  command.add_option("--copies", copies, "Stretched copies of each training object")->group(group)->type_name("N");
}

Settings SettingsArguments::settings() const {
  return applied_to(spincat::preset(preset));
}

Settings SettingsArguments::applied_to(Settings s) const {
  override(s.seed, seed);
  override(s.prepare.points, points);
  override(s.prepare.spin_points, spin_points);
  override(s.spin.image_width, image_width);
  override(s.encoding, encoding);
  override(s.words, words);
  override(s.draws, draws);
  override(s.copies, copies);
  if (trained_for && choice_of<TrainedFor>("--for", *trained_for) == TrainedFor::views && !views) {
    throw InputError("--for views asks for --views N");
  }
  if (views) {
    if (trained_for && *trained_for != "views") {
      throw InputError("--views and --for " + *trained_for + " exclude each other");
    }
    s = trained_by_views(s, *views);
  }
  if (encoding && make_encoding(*encoding)->gives_local_features()) {  // which cannot be joined
    s.plain_samples = false;
    s.draws = draws.value_or(1);
  }
  if (up) {
    s.up = choice_of<UpAxis>("--up", *up);
  }
  if (trained_for) {
    s.trained_for = choice_of<TrainedFor>("--for", *trained_for);
  }
  if (kernel) {
    s.judge.kernel = choice_of<KernelKind>("--kernel", *kernel);
    s.judge.c = default_c(s.judge.kernel);
  }
  override(s.judge.c, c);
  if (surface) {
    s.prepare.surface = choice_of<SurfaceKind>("--surface", *surface);
  }
  if (support_angle) {  // asking for an angle means the hard support angle
    s.spin.support_angle = *support_angle;
    s.spin.angle_test = AngleTest::cutoff;
  }
  if (bin_size) {
    const BinSize size = parse_bin_size(*bin_size);
    s.spin.bin_size = size.value;
    override(s.bin_size_unit, size.unit);
  }
  s.validate();
  return s;
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
