#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/spin_points.h"
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
  fs::path index_output;
  fs::path normals;
  fs::path keypoints;
  double radius = 0.0;  // 0: the settings say the size of a bin
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
  Settings settings = choices.settings();
  if (arguments.radius > 0.0) {
    const int width = settings.spin.image_width;
    settings.spin.bin_size = settings.spin.convention == SpinConvention::pcl ? pcl_bin_size(arguments.radius, width)
                                                                             : arguments.radius / width;
    settings.bin_size_unit = BinSizeUnit::absolute;
    settings.validate();
  }
  return settings;
}

// What the images are of and made from, in the prepared frame.
struct SpinObject {
  PreparedObject object;
  SpinImageParams params;
  std::optional<SpinPoints> chosen;  // none: every surface point
  std::size_t points_in_file = 0;

  const OrientedPoints& spin_points() const { return chosen ? chosen->points : object.surface; }
  const std::vector<std::uint32_t>& spin_rows() const { return chosen ? chosen->rows : object.surface_rows; }

  // How many of the file's points take no part; none where points are drawn.
  std::size_t left_out() const { return object.surface_rows.empty() ? 0 : points_in_file - object.surface_rows.size(); }
};

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
void write_points(const fs::path& file, const SpinObject& spin) {
  const PreparedObject& object = spin.object;
  const OrientedPoints& points = spin.spin_points();
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

// Which point of the file each spin point is.
void write_index(const fs::path& file, std::span<const std::uint32_t> rows) {
  const std::vector<std::int64_t> numbers(rows.begin(), rows.end());
  OutputFile out(file);
  out.write(npy_header(std::array{numbers.size()}, "<i8"));
  out.write({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::int64_t)});
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

void write_sheet(const SpinArguments& arguments, const DenseObject& object, std::size_t count, int threads,
                 ProgressBar& bar) {
  const OrientedPoints chosen = evenly_chosen(object.spin_points, count);
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

SpinObject prepared_object(const SpinArguments& arguments, const Settings& settings) {
  Object object = read_object(arguments.file, arguments.limits);
  SpinObject spin;
  spin.points_in_file = points_in_file(object);
  if (!arguments.normals.empty()) {
    object = with_normals(object, arguments.normals);
  }
  auto [prepared, params] = naming_file(arguments.file, [&] { return prepare_object(object, settings); });
  spin.params = params;
  if (!arguments.keypoints.empty()) {
    spin.chosen = read_keypoints(arguments.keypoints, prepared, spin.points_in_file);
  } else if (arguments.settings.asks_for("spin_points")) {
    spin.chosen = SpinPoints{std::move(prepared.spin_points), std::move(prepared.spin_rows)};
  }
  spin.object = std::move(prepared);
  if (!arguments.index_output.empty() && spin.spin_rows().empty()) {
    throw InputError("--index-output", "the spin points are no points of the file: they are drawn, or your own");
  }
  return spin;
}

// Where a name leads to, as far as that can be told; whoever writes there says what is wrong with it.
fs::path place_of(const fs::path& file) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : place;
}

// Before the work, not after it.
void check_outputs(const SpinArguments& arguments) {
  const std::array<std::pair<const char*, const fs::path&>, 3> outputs = {{{"--output", arguments.output},
                                                                           {"--points-output", arguments.points_output},
                                                                           {"--index-output", arguments.index_output}}};
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const auto& [option, file] = outputs[k];
    if (file.empty()) {
      continue;
    }
    const bool may_be_picture = k == 0;
    if (lower_extension(file) != ".npy" && !(may_be_picture && lower_extension(file) == ".png")) {
      throw InputError(file.string(),
                       fmt::format("expected a name that ends in .npy{}", may_be_picture ? " or .png" : ""));
    }
    for (std::size_t other = 0; other < k; ++other) {
      if (place_of(file) == place_of(outputs[other].second)) {
        throw InputError(file.string(), fmt::format("{} and {} name the same file", outputs[other].first, option));
      }
    }
    check_writable(file);
  }
}

// Before the work, not after it.
void check_arguments(const SpinArguments& arguments) {
  if (arguments.radius > 0.0 && arguments.settings.asks_for("bin_size")) {
    throw InputError("--radius", "says the size of a bin, as --bin-size does; give one of them");
  }
  if (!arguments.keypoints.empty() && arguments.settings.asks_for("spin_points")) {
    throw InputError("--keypoints", "says which points the images are of, as --spin-points does; give one of them");
  }
  check_outputs(arguments);
}

RunIdentity spin_identity(const SpinArguments& arguments, const Settings& settings) {
  FilesIdentity data;
  for (const fs::path& file : {arguments.file, arguments.normals, arguments.keypoints}) {
    if (!file.empty()) {
      data.add(file);
    }
  }
  const std::string more =
      fmt::format("{} {}", arguments.settings.asks_for("spin_points"), limits_text(arguments.limits));
  return {settings_identity("spin", settings, more), data.text()};
}

void print_result(const SpinArguments& arguments, const SpinObject& spin, std::size_t images) {
  const SpinImageShape shape = spin.params.shape();
  const std::size_t all = spin.spin_points().size();
  if (arguments.run.json) {
    fmt::print("{}\n", spin_json({.file = arguments.output.string(),
                                  .images = images,
                                  .spin_points = all,
                                  .surface_points = spin.object.surface.size(),
                                  .left_out = spin.left_out(),
                                  .shape = shape,
                                  .bin_size = spin.params.bin_size / spin.object.scale}));
    return;
  }
  fmt::print("wrote {}: {}{} images of {} x {} from {} surface points{}\n", printable(arguments.output.string()),
             images, images < all ? fmt::format(" of {}", all) : "", shape.rows, shape.columns,
             spin.object.surface.size(),
             spin.left_out() == 0
                 ? ""
                 : fmt::format("; left out: {} of the file's {} points", spin.left_out(), spin.points_in_file));
}

int run_spin(const SpinArguments& arguments, TaskFarm& farm) {
  const Settings settings = spin_settings(arguments);
  check_arguments(arguments);
  FarmRun run(farm, arguments.run);
  const SpinObject spin = prepared_object(arguments, settings);
  const OrientedPoints& spin_points = spin.spin_points();
  const DenseObject dense{spin.object.surface, spin_points, spin.params};
  std::size_t images = spin_points.size();
  {
    ProgressBar bar(arguments.run);
    if (lower_extension(arguments.output) == ".png") {
      images = std::min(images, static_cast<std::size_t>(arguments.sheet));
      write_sheet(arguments, dense, images, farm.threads(), bar);
    } else {
      run.keep_journal(arguments.output, [&] { return spin_identity(arguments, settings); });
      write_images(arguments, farm, dense, bar);
    }
  }
  if (!arguments.points_output.empty()) {
    write_points(arguments.points_output, spin);
  }
  if (!arguments.index_output.empty()) {
    write_index(arguments.index_output, spin.spin_rows());
  }
  run.finish();
  if (arguments.output != "/dev/stdout") {  // the result went there; nothing must follow it
    print_result(arguments, spin, images);
  }
  return 0;
}

void add_files(CLI::App& command, SpinArguments& arguments) {
  const auto add = [&](const char* name, fs::path& file, const char* help) {
    return command.add_option(name, file, help)->type_name("FILE");
  };
  add("file", arguments.file, "An object")->required();
  add("-o,--output", arguments.output, "A .npy file (K x rows x columns) or a .png contact sheet")->required();
  add("--points-output", arguments.points_output,
      "A .npy file for the spin points: K x 6, positions in the file's unit and normals");
  add("--index-output", arguments.index_output, "A .npy file for which points of the file they are (0: the first)");
  add("--keypoints", arguments.keypoints,
      "A .npy file of the points to make images of: indices of the file's points, or points of your own, K x 6, with "
      "the axes of their images");
  add("--normals", arguments.normals, "A .npy file of normals, N x 3, one for each point (or vertex) of the file");
  command
      .add_option("--radius", arguments.radius,
                  "Instead of a bin size: how far images reach, in the file's unit; with --convention pcl PCL's search "
                  "radius")
      ->type_name("LENGTH")
      ->check(in_range(SpinImageParams::kBinSize));
}

}  // namespace

Command add_spin(CLI::App& parent) {
  auto arguments = std::make_shared<SpinArguments>();
  CLI::App* command = parent.add_subcommand("spin", "Make the spin images themselves, for other tools");
  command->footer(
      "Example:\n"
      "  spincat spin scan.ply -o images.npy --points-output points.npy\n"
      "  spincat spin chair.obj -o sheet.png --surface samples --bin-size 0.1rel\n"
      "  spincat spin scan.pcd -o i.npy --convention pcl --radius 2 --keypoints k.npy\n"
      "Without --spin-points and --keypoints there is an image at every surface point, in the order of the file's "
      "points that are "
      "used.");
  add_files(*command, *arguments);
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
