#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "figures.h"
#include "spincat/background/pieces.h"
#include "spincat/camera/render/sensor_noise.h"
#include "spincat/camera/render/table_scene.h"
#include "spincat/camera/segment/segment.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/files/file.h"
#include "spincat/geometry/random.h"

namespace spincat::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kFewestPixels = 300.0;  // of a part, for it to count
constexpr int kSeeds = 20;

// A depth picture and, where there is one, what its pixels show.
struct LabelledFrame {
  std::string name;
  DepthImage image;
  std::vector<std::uint16_t> labels;  // empty: none
  Intrinsics intrinsics;
};

std::vector<std::uint16_t> labels_in(const fs::path& file) {
  const DepthImage read = decode_depth_png(read_file(file), 1.0);
  std::vector<std::uint16_t> labels;
  for (const float label : read.depth) {
    labels.push_back(static_cast<std::uint16_t>(label));
  }
  return labels;
}

// Where the labels of a depth picture lie in the collections that there are: NAME/depth.png with NAME/label.png,
// NAME-depth.png with NAME-label.png, NAME.png with labels/NAME.png.
fs::path labels_of(const fs::path& depth) {
  std::string name = depth.filename().string();
  if (const std::size_t at = name.find("depth"); at != std::string::npos) {
    return depth.parent_path() / name.replace(at, 5, "label");
  }
  return depth.parent_path() / "labels" / name;
}

bool is_depth_picture(const fs::path& file) {
  const std::string folder = file.parent_path().filename().string();
  return file.extension() == ".png" && file.filename().string().find("label") == std::string::npos &&
         folder != "labels";
}

// All depth pictures below a folder; the nearest camera.txt above each is its own.
std::vector<LabelledFrame> frames_below(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_depth_picture(entry.path())) {
      files.insert(entry.path());
    }
  }
  std::vector<LabelledFrame> frames;
  for (const fs::path& file : files) {
    fs::path place = file.parent_path();
    while (!fs::exists(place / "camera.txt") && place != folder && place.has_relative_path()) {
      place = place.parent_path();
    }
    const CameraCalibration calibration = read_calibration(place / "camera.txt");
    const double units = calibration.units_per_metre.value_or(kUsualUnits);
    LabelledFrame frame{
        fs::relative(file, folder).string(), decode_depth_png(read_file(file), units), {}, calibration.intrinsics};
    if (fs::exists(labels_of(file))) {
      frame.labels = labels_in(labels_of(file));
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

// How the parts of one frame and the objects that were found overlap.
struct Overlaps {
  std::map<int, double> parts;                 // pixels of each part
  std::map<int, double> objects;               // of each object
  std::map<std::pair<int, int>, double> both;  // part, object
  std::map<int, double> of_any_part;           // of each object

  double best(int part) const {
    double best = 0.0;
    for (const auto& [pair, shared] : both) {
      if (pair.first == part) {
        best = std::max(best, shared / (parts.at(part) + objects.at(pair.second) - shared));
      }
    }
    return best;
  }
};

Overlaps overlaps_of(const DepthImage& image, const std::vector<std::uint16_t>& labels, int first_label,
                     const std::vector<std::uint16_t>& ids) {
  Overlaps overlaps;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_part = labels[i] >= first_label && image.depth[i] > 0.0F;
    const int id = ids.empty() ? 0 : ids[i];
    overlaps.parts[labels[i]] += is_part ? 1.0 : 0.0;
    if (id != 0) {
      overlaps.objects[id] += 1.0;
      overlaps.both[{labels[i], id}] += is_part ? 1.0 : 0.0;
      overlaps.of_any_part[id] += is_part ? 1.0 : 0.0;
    }
  }
  return overlaps;
}

struct Tally {
  int frames = 0;
  int tables = 0;
  int parts = 0;
  int half = 0;
  int three_quarters = 0;
  int false_objects = 0;

  void add(const Overlaps& overlaps) {
    for (const auto& [part, pixels] : overlaps.parts) {
      if (pixels >= kFewestPixels) {
        const double best = overlaps.best(part);
        ++parts;
        half += best >= 0.5 ? 1 : 0;
        three_quarters += best >= 0.75 ? 1 : 0;
      }
    }
    for (const auto& [object, pixels] : overlaps.objects) {
      false_objects += overlaps.of_any_part.at(object) < 0.3 * pixels ? 1 : 0;
    }
  }

  Json json() const {
    const double all = std::max(parts, 1);
    return {{"frames", frames},
            {"tables", tables},
            {"parts", parts},
            {"found_half", half / all},
            {"found_three_quarters", three_quarters / all},
            {"false_objects", false_objects}};
  }
};

Segmentation objects_in(const DepthImage& image, const Intrinsics& intrinsics, SegmentSplit split, Tally& tally) {
  ++tally.frames;
  const std::optional<SupportPlane> table = find_table(image, intrinsics, {});
  if (!table) {
    return {};
  }
  ++tally.tables;
  SegmentSettings settings;
  settings.split = split;
  return segment(image, intrinsics, *table, settings);
}

// How often another plane is found than with a hundred times as many trials: 3 degrees or 3 cm off.
int missed_tables(const LabelledFrame& frame) {
  TableSettings settings;
  settings.trials = 20'000;
  settings.seed = 777;
  const std::optional<SupportPlane> best = find_table(frame.image, frame.intrinsics, settings);
  int missed = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    settings = {};
    settings.seed = static_cast<std::uint64_t>(seed);
    const std::optional<SupportPlane> found = find_table(frame.image, frame.intrinsics, settings);
    const bool is_same = best.has_value() == found.has_value() &&
                         (!best || (found->normal.dot(best->normal) > std::cos(3.0 * std::numbers::pi / 180.0) &&
                                    std::abs(found->offset - best->offset) < 0.03F));
    missed += is_same ? 0 : 1;
  }
  return missed;
}

Mesh block(double half_x, double half_y, double height) {
  return background::box({0.0, 0.0, 0.5 * height}, {2.0 * half_x, 2.0 * half_y, height});
}

Mesh tin(double radius, double height) {
  return background::lathe({{0.0, 0.0}, {radius, 0.0}, {radius, height}, {0.0, height}});
}

// Up to six blocks and tins, 4 to 24 cm wide and 2 to 30 cm high, 2 cm apart at least, on a table of .6 to 1.8 m before
// a wall (2 cm to 1.5 m behind it) and over a floor.
TableScene random_room(Random& random) {
  TableScene scene;
  scene.half_width = random.uniform(0.3, 0.9);
  std::vector<Eigen::Vector3d> taken;  // x, y, radius
  for (std::uint64_t k = random.below(7); k > 0; --k) {
    const double x = random.uniform(0.02, 0.12);
    const double y = random.uniform(0.02, 0.12);
    const double height = random.uniform(0.02, 0.3);
    const bool is_tin = random.uniform() < 0.5;
    const double turn = random.uniform(0.0, 0.5);  // of a whole one
    const double radius = is_tin ? x : std::hypot(x, y);
    const double reach = scene.half_width - 0.1;
    for (int trial = 0; trial < 50; ++trial) {
      const double at_x = random.uniform(-reach, reach);
      const double at_y = random.uniform(-reach, reach);
      const bool is_free = std::ranges::all_of(taken, [&](const Eigen::Vector3d& other) {
        return std::hypot(at_x - other.x(), at_y - other.y()) > radius + other.z() + 0.02;
      });
      if (is_free) {
        const Mesh thing = background::turned(is_tin ? tin(x, height) : block(x, y, height), turn, Vec3::UnitZ());
        scene.things.push_back(background::moved(thing, Vec3(at_x, at_y, 0.0)));
        taken.emplace_back(at_x, at_y, radius);
        break;
      }
    }
  }
  const double floor_below = random.uniform(0.4, 0.8);
  scene.room = room_around(floor_below, scene.half_width + random.uniform(0.02, 1.5));
  return scene;
}

}  // namespace

Json labelled_figures(const fs::path& folder, int first_label) {
  const std::vector<LabelledFrame> frames = frames_below(folder);
  Json result = Json::object();
  for (const auto& [name, split] : {std::pair("concave", SegmentSplit::concave), {"none", SegmentSplit::none}}) {
    Tally tally;
    for (const LabelledFrame& frame : frames) {
      if (!frame.labels.empty()) {
        const Segmentation found = objects_in(frame.image, frame.intrinsics, split, tally);
        tally.add(overlaps_of(frame.image, frame.labels, first_label, found.ids));
      }
    }
    result[name] = tally.json();
  }
  int missed = 0;
  for (const LabelledFrame& frame : frames) {
    missed += missed_tables(frame);
  }
  result["runs"] = frames.size() * kSeeds;
  result["missed_tables"] = missed;
  return result;
}

Json room_figures(int count, std::uint64_t seed) {
  Json result = Json::object();
  for (const auto& [name, split] : {std::pair("concave", SegmentSplit::concave), {"none", SegmentSplit::none}}) {
    Tally tally;
    for (int k = 0; k < count; ++k) {
      Random random(derive_seed(seed, static_cast<std::uint64_t>(k)));
      const TableScene scene = random_room(random);
      const double distance = random.uniform(0.8, 1.6);
      const double elevation = random.uniform(20.0, 65.0);
      const double azimuth = random.uniform(-40.0, 40.0);
      SceneView view = view_of(scene, camera_around(distance, elevation, azimuth), Intrinsics{}, 640, 480);
      add_sensor_noise(Intrinsics{}, random.uniform(0.5, 1.5), random, view.image);
      const Segmentation found = objects_in(view.image, Intrinsics{}, split, tally);
      tally.add(overlaps_of(view.image, view.things, 1, found.ids));
    }
    result[name] = tally.json();
  }
  return result;
}

}  // namespace spincat::bench
