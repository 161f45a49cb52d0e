#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "app/commands/commands.h"
#include "app/options.h"
#include "app/ranks/farm_run.h"
#include "app/terminal/parse_errors.h"
#include "app/terminal/progress_bar.h"
#include "spincat/describe/dense_object.h"
#include "spincat/describe/describe.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/output_file.h"
#include "spincat/files/paths.h"
#include "spincat/io/npy.h"
#include "spincat/io/read_object.h"
#include "spincat/report/json.h"
#include "spincat/report/picture.h"
#include "spincat/report/text_table.h"
#include "spincat/spin/spin_images.h"

namespace spincat::app {
namespace {

namespace fs = std::filesystem;

struct SpinArguments {
  fs::path file;
  fs::path output;
  fs::path points_output;
  SettingsArguments settings;
  ReadLimits limits;
  RunOptions run;
  int sheet = 64;
};

// What researchers expect unless they say otherwise: the object's own points, and bilinear images with bins of one mesh
// resolution that see every angle.
Settings own_settings() {
  Settings s = preset("paper");
  s.spin.support_angle = 180.0;
  s.spin.bin_size = 1.0;
  s.bin_size_unit = BinSizeUnit::resolution;
  return s;
}

// PCL's images know no normals that point away.
Settings spin_settings(const SpinArguments& arguments) {
  SettingChoices choices = arguments.settings.choices();
  const auto is_pcl = [](const ChosenSetting& one) { return one.name == "convention" && one.text == "pcl"; };
  if (std::ranges::any_of(choices.chosen, is_pcl)) {
    choices.base.spin.support_angle = 90.0;
  }
  return choices.settings();
}

// Some points of many, evenly chosen, in their order.
OrientedPoints evenly_chosen(const OrientedPoints& points, std::size_t count) {
  OrientedPoints chosen(std::min(count, points.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::size_t i = k * points.size() / chosen.size();
    chosen.set(k, points.position(i), points.normal(i));
  }
  return chosen;
}

std::string_view as_bytes(std::span<const float> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

// Position (in the file's unit) and normal of each spin point, K x 6.
void write_points(const fs::path& file, const OrientedPoints& points, const PreparedObject& object) {
  OutputFile out(file);
  out.write(npy_header(std::array<std::size_t, 2>{points.size(), 6}));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 p = points.position(k).cast<double>() / object.scale + object.centre;
    const Eigen::Vector3f n = points.normal(k);
    out.write(as_bytes(std::array{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                                  n.x(), n.y(), n.z()}));
  }
  out.commit();
}

// The images as they come, in their order.
void write_images(const SpinArguments& arguments, TaskFarm& farm, const DenseObject& object, ProgressBar& bar) {
  const SpinImageShape shape = object.params.shape();
  std::vector<std::size_t> sizes = {object.spin_points.size()};
  if (shape.channels > 1) {
    sizes.push_back(shape.channels);
  }
  sizes.insert(sizes.end(), {shape.rows, shape.columns});
  OutputFile out(arguments.output);
  out.write(npy_header(sizes));
  const auto tick = [&](std::size_t done) { bar.update("making spin images", done, object.spin_points.size()); };
  const auto write = [&](std::size_t, std::span<const float> images) { out.write(as_bytes(images)); };
  if (farm.is_distributed()) {
    make_spin_images(farm, object, write, tick);
  } else {
    const auto write_block = [&](const SpinImageBlock& block) {
      write(block.first, block.images.values());
      tick(block.first + block.images.count());
    };
    make_spin_images(object.surface, object.spin_points, object.params, write_block, farm.threads());
  }
  out.commit();
}

void write_sheet(const SpinArguments& arguments, const DenseObject& object, int threads, ProgressBar& bar) {
  const OrientedPoints chosen = evenly_chosen(object.spin_points, static_cast<std::size_t>(arguments.sheet));
  SpinImages images(chosen.size(), object.params.shape());
  const auto keep = [&](const SpinImageBlock& block) {
    for (std::size_t k = 0; k < block.images.count(); ++k) {
      std::ranges::copy(block.images.image(k), images.image(block.first + k).begin());
    }
    bar.update("making spin images", block.first + block.images.count(), chosen.size());
  };
  make_spin_images(object.surface, chosen, object.params, keep, threads);
  OutputFile out(arguments.output);
  out.write(encode_png(contact_sheet(images)));
  out.commit();
}

Preparation prepared_object(const SpinArguments& arguments, const Settings& settings) {
  return naming_file(arguments.file,
                     [&] { return prepare_object(read_object(arguments.file, arguments.limits), settings); });
}

// Where a name leads to, as far as that can be told; whoever writes there says what is wrong with it.
fs::path place_of(const fs::path& file) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : place;
}

// Before the work, not after it.
void check_outputs(const SpinArguments& arguments) {
  check_writable(arguments.output);
  if (arguments.points_output.empty()) {
    return;
  }
  if (lower_extension(arguments.points_output) != ".npy") {
    throw InputError(arguments.points_output.string(), "expected a name that ends in .npy");
  }
  if (place_of(arguments.points_output) == place_of(arguments.output)) {
    throw InputError(arguments.output.string(), "--output and --points-output name the same file");
  }
  check_writable(arguments.points_output);
}

// Before the work, not after it.
void check_arguments(const SpinArguments& arguments) {
  if (lower_extension(arguments.output) != ".png" && lower_extension(arguments.output) != ".npy") {
    throw InputError(arguments.output.string(), "expected a name that ends in .npy or .png");
  }
  check_outputs(arguments);
}

RunIdentity spin_identity(const SpinArguments& arguments, const Settings& settings) {
  FilesIdentity data;
  data.add(arguments.file);
  const std::string more =
      fmt::format("{} {}", arguments.settings.asks_for("spin_points"), limits_text(arguments.limits));
  return {settings_identity("spin", settings, more), data.text()};
}

int run_spin(const SpinArguments& arguments, TaskFarm& farm) {
  const Settings settings = spin_settings(arguments);
  check_arguments(arguments);
  FarmRun run(farm, arguments.run);
  const auto [object, params] = prepared_object(arguments, settings);
  const bool chosen = arguments.settings.asks_for("spin_points");
  const OrientedPoints& spin_points = chosen ? object.spin_points : object.surface;
  const DenseObject dense{object.surface, spin_points, params};
  {
    ProgressBar bar(arguments.run);
    if (lower_extension(arguments.output) == ".png") {
      write_sheet(arguments, dense, farm.threads(), bar);
    } else {
      run.keep_journal(arguments.output, [&] { return spin_identity(arguments, settings); });
      write_images(arguments, farm, dense, bar);
    }
  }
  if (!arguments.points_output.empty()) {
    write_points(arguments.points_output, spin_points, object);
  }
  run.finish();
  if (arguments.output == "/dev/stdout") {
    return 0;  // the result went there; nothing must follow it
  }
  if (arguments.run.json) {
    fmt::print("{}\n", spin_json(arguments.output.string(), spin_points.size(), params, object));
  } else {
    fmt::print("wrote {}: {} spin points, images of {} x {} from {} surface points\n",
               printable(arguments.output.string()), spin_points.size(), params.shape().rows, params.shape().columns,
               object.surface.size());
  }
  return 0;
}

}  // namespace

Command add_spin(CLI::App& parent) {
  auto arguments = std::make_shared<SpinArguments>();
  CLI::App* command = parent.add_subcommand("spin", "Make the spin images themselves, for other tools");
  command->footer(
      "Example:\n"
      "  spincat spin scan.ply -o images.npy --points-output points.npy\n"
      "  spincat spin chair.obj -o sheet.png --surface samples --bin-size 0.1rel\n"
      "Without --spin-points there is an image at every surface point, in the order of the file's points that are "
      "used.");
  command->add_option("file", arguments->file, "An object")->type_name("FILE")->required();
  command->add_option("-o,--output", arguments->output, "A .npy file (K x rows x columns) or a .png contact sheet")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--points-output", arguments->points_output,
                   "A .npy file for the spin points: K x 6, positions in the file's unit and normals")
      ->type_name("FILE");
  command->add_option("--sheet", arguments->sheet, "Images on a contact sheet, evenly chosen")
      ->type_name("N")
      ->check(in_range({1, 1'000}))
      ->type_name("N")
      ->capture_default_str();
  arguments->settings.add_to(*command, SettingStage::images, own_settings());
  add_limit_options(*command, arguments->limits);
  arguments->run.add_to(*command);
  arguments->run.add_farm_options_to(*command);
  return [arguments](TaskFarm& farm) { return run_spin(*arguments, farm); };
}

}  // namespace spincat::app
