// Scenes of a data set's objects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "figures.h"
#include "spincat/camera/render/table_scene.h"
#include "spincat/classify/model.h"

namespace spincat::bench {

// The categories of all objects.
std::vector<std::uint32_t> labels_of(const Dataset& objects);

// Some of the objects; all categories stay.
Dataset part_of(const Dataset& objects, std::span<const std::uint32_t> which);

// A model that was trained by views of all objects.
Model views_model(const Dataset& objects, const SceneOptions& options);

// A scene, how it is looked at, and what its things are.
struct MadeScene {
  TableScene scene;
  std::vector<std::uint32_t> categories;  // of the things
  double distance = 1.0;
  double elevation = 40.0;
  double azimuth = 0.0;

  // What a Kinect sees, so many degrees further around.
  SceneView frame(double further) const;
};

// Puts objects on tables: each of a category drawn evenly from all, in a room with a floor and a wall.
class SceneMaker {
 public:
  SceneMaker(const Dataset& objects, UpAxis up);
  // Precondition: at most eight things.
  MadeScene make(std::size_t things, Random& random) const;

 private:
  UpAxis up_;
  std::map<std::uint32_t, std::vector<Mesh>> meshes_;  // by category
};

}  // namespace spincat::bench
