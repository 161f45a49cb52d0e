// What a depth camera would record while it swings around models on a table: a folder for spincat camera.
//
//   table_scene FOLDER FRAMES SEED MODEL...
//
// Takes up to four models at a time, in the order given, for 60 frames each; in their files y points up.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "spincat/camera/render/sensor_noise.h"
#include "spincat/camera/render/table_scene.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/io/read_object.h"

namespace {

using namespace spincat;  // NOLINT(google-build-using-namespace)

constexpr std::size_t kThings = 4;
constexpr int kFramesEach = 60;
constexpr double kUnitsPerMetre = 5'000.0;

Mesh read_mesh(const std::string& file) {
  Object object = read_object(file);
  if (!std::holds_alternative<Mesh>(object)) {
    throw InputError(file, "is no mesh");
  }
  return std::get<Mesh>(std::move(object));
}

// Frame `k` of a scene: to and fro by 25 degrees, a little up and down.
SceneView frame_of(const TableScene& scene, int k, double around) {
  const double swing = std::sin(2.0 * std::numbers::pi * k / kFramesEach);
  return view_of(scene, camera_around(1.25, 38.0 + 4.0 * swing, around + 25.0 * swing), Intrinsics{}, 640, 480);
}

void render(const std::filesystem::path& folder, int frames, std::uint64_t seed, std::span<char*> files) {
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / "camera.txt", calibration_text({Intrinsics{}, kUnitsPerMetre, 640, 480}));
  Random random(seed);
  TableScene scene;
  double around = 0.0;
  for (int k = 0; k < frames; ++k) {
    if (k % kFramesEach == 0) {
      std::vector<Mesh> models;
      for (std::size_t i = 0; i < std::min(kThings, files.size()); ++i) {
        const std::size_t scenes_before = static_cast<std::size_t>(k / kFramesEach);
        models.push_back(read_mesh(files[(scenes_before * kThings + i) % files.size()]));
      }
      scene = random_scene(models, UpAxis::y, random);
      around = random.uniform(0.0, 360.0);
    }
    DepthImage image = frame_of(scene, k, around).image;
    add_sensor_noise(Intrinsics{}, 1.0, random, image);
    write_file_atomically(folder / fmt::format("{:06}.png", k), encode_depth_png(image, kUnitsPerMetre));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    fmt::print(stderr, "usage: table_scene FOLDER FRAMES SEED MODEL...\n");
    return 2;
  }
  try {
    const std::span<char*> files(argv + 4, static_cast<std::size_t>(argc - 4));
    render(argv[1], std::stoi(argv[2]), std::stoull(argv[3]), files);
  } catch (const std::exception& error) {
    fmt::print(stderr, "table_scene: {}\n", error.what());
    return 2;
  }
  return 0;
}
