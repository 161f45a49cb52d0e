// Rendered scenes of models on a table, with what belongs to what: to try a camera out, and to measure.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/camera/render/viewpoint.h"
#include "spincat/camera/segment/table.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"

namespace spincat {

// The model on the table z = 0 with its middle over the origin: its largest extent `size` metres, its own `up` axis
// along z, turned by `turn` about it. Throws InputError (without a file name) when it has no extent. Precondition: up
// is not none.
Mesh on_table(const Mesh& model, UpAxis up, double size, double turn);

// A square table and things on it, in a world in metres whose z axis points up.
struct TableScene {
  double half_width = 0.7;  // of the table, from the origin to its edges
  std::vector<Mesh> things;
  std::vector<Mesh> room;  // what else there is, and is no thing: floor, walls

  // The largest distance of a thing's outline from the origin's axis, 0 where there is none.
  double reach() const;
};

// What a camera sees of a scene, without noise.
struct SceneView {
  DepthImage image;
  std::vector<std::uint16_t> things;  // of each pixel: the number of the thing it shows, from 1; 0 for none
  SupportPlane table;
};

SceneView view_of(const TableScene& scene, const Viewpoint& viewpoint, const Intrinsics& intrinsics, int width,
                  int height);

// The models (all with the same `up`) beside each other in random places on a table: .15 to .35 m large, turned at
// random, at least 5 cm between their outlines. Precondition: at most eight models. Throws as on_table does.
TableScene random_scene(std::span<const Mesh> models, UpAxis up, Random& random);

// A floor that far below the table and a wall that far behind it: the side towards positive y.
std::vector<Mesh> room_around(double floor_below, double wall_behind);

// A camera that looks at the middle of the table from `distance` metres, `elevation` degrees over it, `azimuth` degrees
// around it.
Viewpoint camera_around(double distance, double elevation, double azimuth);

}  // namespace spincat
