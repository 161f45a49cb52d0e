#include "scenes.h"

#include <iterator>
#include <variant>

#include "spincat/io/read_object.h"
#include "spincat/train/train.h"

namespace spincat::bench {

std::vector<std::uint32_t> labels_of(const Dataset& objects) {
  std::vector<std::uint32_t> labels;
  for (const DatasetObject& object : objects.objects) {
    labels.push_back(object.category);
  }
  return labels;
}

Dataset part_of(const Dataset& objects, std::span<const std::uint32_t> which) {
  Dataset part = objects;
  part.objects.clear();
  for (const std::uint32_t i : which) {
    part.objects.push_back(objects.objects[i]);
  }
  return part;
}

Model views_model(const Dataset& objects, const SceneOptions& options) {
  Settings settings = trained_by_views(preset("default"), options.views);
  settings.up = options.up;
  return train(objects, settings, {.threads = options.threads}).model;
}

SceneView MadeScene::frame(double further) const {
  return view_of(scene, camera_around(distance, elevation, azimuth + further), Intrinsics{}, 640, 480);
}

SceneMaker::SceneMaker(const Dataset& objects, UpAxis up) : up_(up) {
  for (const DatasetObject& object : objects.objects) {
    Object read = read_object(object.file);
    if (Mesh* mesh = std::get_if<Mesh>(&read)) {
      meshes_[object.category].push_back(std::move(*mesh));
    }
  }
}

MadeScene SceneMaker::make(std::size_t things, Random& random) const {
  MadeScene made;
  std::vector<Mesh> models;
  for (std::size_t k = 0; k < things; ++k) {
    const auto& [category, meshes] =
        *std::next(meshes_.begin(), static_cast<std::ptrdiff_t>(random.below(meshes_.size())));
    models.push_back(meshes[random.below(meshes.size())]);
    made.categories.push_back(category);
  }
  made.scene = random_scene(models, up_, random);
  made.scene.room = room_around(0.72, made.scene.half_width + random.uniform(0.3, 1.5));
  // The nearest thing no nearer than .8 m; the middle of the table between that and 1.5 m.
  made.distance = random.uniform(0.8 + 0.3, 1.5);
  made.elevation = random.uniform(25.0, 55.0);
  made.azimuth = random.uniform(-40.0, 40.0);  // the wall stays behind the table
  return made;
}

}  // namespace spincat::bench
