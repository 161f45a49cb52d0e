#include "spincat/camera/render/table_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "spincat/camera/render/render.h"
#include "spincat/error.h"

namespace spincat {
namespace {

constexpr double kGap = 0.05;   // metres between things
constexpr double kRing = 0.12;  // metres: how much further out a thing is tried where there is no room
constexpr int kTriesARing = 12;
constexpr double kLeastSize = 0.15;
constexpr double kMostSize = 0.35;

double degrees(double angle) {
  return angle * std::numbers::pi / 180.0;
}

// Turns the model's own up to +z.
Eigen::Matrix3d upright(UpAxis up) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (up == UpAxis::y) {
    axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  } else if (up == UpAxis::x) {
    axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  }
  return axes;
}

Eigen::AlignedBox3d bounds_of(const Mesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& v : mesh.vertices) {
    bounds.extend(v);
  }
  return bounds;
}

// The circle around a thing's outline on the table.
struct Circle {
  Eigen::Vector2d centre;
  double radius;
};

double radius_of(const Mesh& mesh) {
  double radius = 0.0;
  for (const Vec3& v : mesh.vertices) {
    radius = std::max(radius, v.head<2>().norm());
  }
  return radius;
}

// A free place for a circle, as near to the middle as it is found.
Eigen::Vector2d free_place(double radius, const std::vector<Circle>& taken, Random& random) {
  for (double furthest = 0.0;; furthest += kRing) {
    for (int k = 0; k < kTriesARing; ++k) {
      const double distance = furthest * std::sqrt(random.uniform());
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      Eigen::Vector2d place = distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (std::ranges::all_of(taken,
                              [&](const Circle& c) { return (c.centre - place).norm() > c.radius + radius + kGap; })) {
        return place;
      }
    }
  }
}

}  // namespace

Mesh on_table(const Mesh& model, UpAxis up, double size, double turn) {
  if (model.vertices.empty()) {
    throw InputError("holds no points");
  }
  const Eigen::AlignedBox3d own = bounds_of(model);
  const double extent = own.sizes().maxCoeff();
  if (!(extent > 0.0)) {
    throw InputError("all its points are at one place");
  }
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix() * upright(up);
  Mesh placed = model;
  for (Vec3& v : placed.vertices) {
    v = rotation * ((v - own.min()) * (size / extent));
  }
  const Eigen::AlignedBox3d now = bounds_of(placed);
  const Vec3 foot(now.center().x(), now.center().y(), now.min().z());
  for (Vec3& v : placed.vertices) {
    v -= foot;
  }
  return placed;
}

double TableScene::reach() const {
  double reach = 0.0;
  for (const Mesh& thing : things) {
    reach = std::max(reach, radius_of(thing));
  }
  return reach;
}

SceneView view_of(const TableScene& scene, const Viewpoint& viewpoint, const Intrinsics& intrinsics, int width,
                  int height) {
  const double h = scene.half_width;
  SceneView view;
  view.table = {(viewpoint.axes * Vec3::UnitZ()).cast<float>(), static_cast<float>(viewpoint.eye.z())};
  view.image = DepthImage(width, height);
  const Mesh top{{{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  draw_depth(viewpoint.to_camera(top), intrinsics, view.image);
  for (const Mesh& each : scene.room) {
    draw_depth(viewpoint.to_camera(each), intrinsics, view.image);
  }
  view.things.assign(view.image.depth.size(), 0);
  for (std::size_t k = 0; k < scene.things.size(); ++k) {
    const std::vector<float> before = view.image.depth;
    draw_depth(viewpoint.to_camera(scene.things[k]), intrinsics, view.image);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (view.image.depth[i] != before[i]) {
        view.things[i] = static_cast<std::uint16_t>(k + 1);
      }
    }
  }
  return view;
}

TableScene random_scene(std::span<const Mesh> models, UpAxis up, Random& random) {
  TableScene scene;
  std::vector<Circle> taken;
  for (const Mesh& model : models) {
    const double size = random.uniform(kLeastSize, kMostSize);
    Mesh thing = on_table(model, up, size, random.uniform(0.0, 2.0 * std::numbers::pi));
    const double radius = radius_of(thing);
    const Eigen::Vector2d place = free_place(radius, taken, random);
    taken.push_back({place, radius});
    for (Vec3& v : thing.vertices) {
      v.head<2>() += place;
    }
    scene.things.push_back(std::move(thing));
  }
  constexpr double kMargin = 0.15;  // of table around everything
  scene.half_width = std::max(scene.half_width, scene.reach() + kMargin);
  return scene;
}

std::vector<Mesh> room_around(double floor_below, double wall_behind) {
  constexpr double kWide = 8.0;
  const double floor = -floor_below;
  const double ceiling = floor + 2.5;
  const double wall = wall_behind;
  return {{{{-kWide, -kWide, floor}, {kWide, -kWide, floor}, {kWide, wall, floor}, {-kWide, wall, floor}},
           {{0, 1, 2}, {0, 2, 3}}},
          {{{-kWide, wall, floor}, {kWide, wall, floor}, {kWide, wall, ceiling}, {-kWide, wall, ceiling}},
           {{0, 1, 2}, {0, 2, 3}}}};
}

Viewpoint camera_around(double distance, double elevation, double azimuth) {
  const double e = degrees(elevation);
  const double a = degrees(azimuth);
  return Viewpoint::looking_at(distance * Vec3(std::cos(e) * std::sin(a), -std::cos(e) * std::cos(a), std::sin(e)),
                               Vec3::Zero());
}

}  // namespace spincat
