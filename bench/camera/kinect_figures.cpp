#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "figures.h"
#include "scenes.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/classify/recogniser.h"
#include "spincat/files/file.h"

namespace spincat::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kSides = 32;
constexpr int kShapes = 40;  // of each category
constexpr double kLeastPixels = 300.0;

// A shape of revolution about y: radius and height of its outline's corners, from the foot up; a radius of 0 closes it.
Mesh turned_outline(const std::vector<Eigen::Vector2d>& outline) {
  Mesh mesh;
  for (const Eigen::Vector2d& corner : outline) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      mesh.vertices.emplace_back(corner.x() * std::cos(angle), corner.y(), corner.x() * std::sin(angle));
    }
  }
  const auto at = [](std::size_t ring, int k) { return static_cast<std::uint32_t>(ring * kSides + k % kSides); };
  for (std::size_t ring = 0; ring + 1 < outline.size(); ++ring) {
    for (int k = 0; k < kSides; ++k) {
      mesh.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring, k + 1)});
      mesh.triangles.push_back({at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)});
    }
  }
  return mesh;
}

Mesh turned_about_z(Mesh mesh, double angle) {
  for (Vec3& v : mesh.vertices) {
    v = Vec3(std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y(),
             v.z());
  }
  return mesh;
}

Mesh random_box(Random& random) {
  const Vec3 half(random.uniform(0.3, 1.0), random.uniform(0.2, 1.0), random.uniform(0.3, 1.0));
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                               (i & 4) != 0 ? half.z() : -half.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Tins, cups, pots and bowls: closed or open above, standing or lying.
Mesh random_round(Random& random) {
  const double height = random.uniform(0.4, 2.2);
  const double foot = random.uniform(0.4, 1.0);
  const double top = random.uniform(0.8, 1.3) * foot;
  std::vector<Eigen::Vector2d> outline = {{0.0, 0.0}, {foot, 0.0}, {top, height}};
  const double kind = random.uniform();
  if (kind < 0.3) {  // a bowl: widens as a part of a sphere
    outline = {{0.0, 0.0}};
    for (int k = 1; k <= 8; ++k) {
      const double angle = 0.5 * std::numbers::pi * k / 8;
      outline.emplace_back(std::sin(angle), 0.8 * (1.0 - std::cos(angle)));
    }
  } else if (kind < 0.65) {  // closed
    outline.emplace_back(0.0, height);
  }
  const Mesh mesh = turned_outline(outline);
  return random.uniform() < 0.2 ? turned_about_z(mesh, 0.5 * std::numbers::pi) : mesh;
}

void write_off(const fs::path& file, const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) {
    text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  }
  for (const Triangle& t : mesh.triangles) {
    text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  }
  write_file_atomically(file, text);
}

Dataset generated_shapes(const fs::path& folder) {
  Random random(1);
  for (const char* kind : {"box", "round"}) {
    fs::create_directories(folder / kind);
    for (int k = 0; k < kShapes; ++k) {
      const bool box = std::string_view(kind) == "box";
      write_off(folder / kind / fmt::format("{}.off", k), box ? random_box(random) : random_round(random));
    }
  }
  return read_dataset({folder});
}

// Whether the labelled part is a box's; scenes.txt of the data tells what is in them.
bool is_box(const std::string& scene, int label) {
  static const std::set<std::string> boxes = {"learn12", "learn22", "learn3"};
  return boxes.contains(scene) || (scene == "learn31" && label >= 30);
}

// The labelled part that most of a segment's pixels belong to, if half of them do, and whether they are that part as a
// whole: intersection over union of a half or more.
struct Part {
  int label = 0;
  bool whole = false;
};

Part part_of(const Segment& segment, const std::vector<std::uint16_t>& ids, const DepthImage& labels) {
  std::map<int, double> shared;
  std::map<int, double> all;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int label = static_cast<int>(labels.depth[i]);
    all[label] += 1.0;
    shared[label] += ids[i] == segment.id ? 1.0 : 0.0;
  }
  const auto pixels = static_cast<double>(segment.pixels);
  for (const auto& [label, count] : shared) {
    if (label >= 20 && count >= 0.5 * pixels) {
      return {label, count >= 0.5 * (pixels + all[label] - count)};
    }
  }
  return {};
}

}  // namespace

Json kinect_figures(const fs::path& scenes, const fs::path& scratch, int views, int threads) {
  SceneOptions options;
  options.views = views;
  options.threads = threads;
  const Model model = views_model(generated_shapes(scratch), options);
  const CameraCalibration calibration = read_calibration(scenes / "camera.txt");
  RecogniserSettings settings;
  settings.segment.split = SegmentSplit::concave;
  int all = 0;
  int right = 0;
  int whole = 0;
  int whole_right = 0;
  Json wrong = Json::array();
  std::set<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.is_directory()) {
      folders.insert(entry.path());
    }
  }
  for (const fs::path& folder : folders) {
    const std::string name = folder.filename().string();
    const DepthImage image =
        decode_depth_png(read_file(folder / "depth.png"), calibration.units_per_metre.value_or(kUsualUnits));
    const DepthImage labels = decode_depth_png(read_file(folder / "label.png"), 1.0);
    const SeenFrame frame = Recogniser(model, settings, threads).look(image, calibration.intrinsics);
    for (const SeenObject& object : frame.objects) {
      const auto [label, is_whole] = part_of(object.segment, frame.segmentation.ids, labels);
      if (label == 0 || static_cast<double>(object.segment.pixels) < kLeastPixels) {
        continue;
      }
      const bool is_right = (model.categories()[object.ballot.winner] == "box") == is_box(name, label);
      ++all;
      right += is_right ? 1 : 0;
      whole += is_whole ? 1 : 0;
      whole_right += is_whole && is_right ? 1 : 0;
      if (!is_right) {
        wrong.push_back(fmt::format("{} {}{}: {} px, confidence {:.2f}", name, label, is_whole ? "" : ", a fragment",
                                    object.segment.pixels, object.confidence));
      }
    }
  }
  return {
      {"parts", whole}, {"parts_right", whole_right}, {"segments", all}, {"segments_right", right}, {"wrong", wrong}};
}

}  // namespace spincat::bench
