#include "spincat/camera/render/views.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "spincat/camera/render/render.h"
#include "spincat/camera/render/sensor_noise.h"
#include "spincat/camera/render/table_scene.h"
#include "spincat/camera/render/viewpoint.h"
#include "spincat/camera/segment/segment_cloud.h"
#include "spincat/error.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

constexpr double kTableMargin = 0.12;  // metres of table that are seen around the model
constexpr int kAttempts = 8;           // at other viewpoints, where a view shows nothing

struct Extent {
  Vec3 low;
  Vec3 high;
};

Extent extent_of(const Mesh& mesh) {
  Extent extent{mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3& v : mesh.vertices) {
    extent.low = extent.low.cwiseMin(v);
    extent.high = extent.high.cwiseMax(v);
  }
  return extent;
}

Mesh table_around(const Mesh& placed) {
  const Extent e = extent_of(placed);
  const Vec3 low = e.low - Vec3::Constant(kTableMargin);
  const Vec3 high = e.high + Vec3::Constant(kTableMargin);
  return {{{low.x(), low.y(), 0}, {high.x(), low.y(), 0}, {high.x(), high.y(), 0}, {low.x(), high.y(), 0}},
          {{0, 1, 2}, {0, 2, 3}}};
}

Viewpoint random_viewpoint(const ViewSettings& settings, double height, Random& random) {
  const double distance = random.uniform(settings.least_distance, settings.most_distance);
  const double elevation = random.uniform(settings.least_elevation, settings.most_elevation) * std::numbers::pi / 180.0;
  const Vec3 middle(0.0, 0.0, 0.5 * height);
  const Vec3 eye = middle + distance * Vec3(0.0, -std::cos(elevation), std::sin(elevation));
  return Viewpoint::looking_at(eye, middle);
}

// The part of a Kinect's picture that shows both meshes.
struct Crop {
  Intrinsics intrinsics;
  DepthImage image;
};

Crop crop_around(const Mesh& table_top, const Mesh& model) {
  const Intrinsics whole;
  Eigen::Vector2d low(1e9, 1e9);
  Eigen::Vector2d high(-1e9, -1e9);
  for (const Mesh* mesh : {&table_top, &model}) {
    for (const Vec3& p : mesh->vertices) {
      const double z = std::max(p.z(), 0.1);
      const Eigen::Vector2d at(whole.fx * p.x() / z, whole.fy * p.y() / z);
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
  }
  constexpr double kMost = 1'000.0;  // pixels from the middle
  low = low.array().max(-kMost).floor();
  high = high.array().min(kMost).ceil();
  Crop crop{whole, DepthImage(static_cast<int>(high.x() - low.x()) + 1, static_cast<int>(high.y() - low.y()) + 1)};
  crop.intrinsics.cx = -low.x();
  crop.intrinsics.cy = -low.y();
  return crop;
}

PointCloud one_view(const Mesh& model, const ViewSettings& settings, Random& random) {
  const double size = random.uniform(settings.least_size, settings.most_size);
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Mesh placed = on_table(model, settings.up, size, turn);
  const Viewpoint viewpoint = random_viewpoint(settings, extent_of(placed).high.z(), random);
  const Mesh table_top = viewpoint.to_camera(table_around(placed));
  const Mesh seen = viewpoint.to_camera(placed);
  auto [intrinsics, image] = crop_around(table_top, seen);
  draw_depth(table_top, intrinsics, image);
  draw_depth(seen, intrinsics, image);
  add_sensor_noise(intrinsics, random.uniform(0.0, settings.most_noise), random, image);
  const SupportPlane table{(viewpoint.axes * Vec3::UnitZ()).cast<float>(), static_cast<float>(viewpoint.eye.z())};
  const Segmentation found = segment(image, intrinsics, table, settings.segment);
  if (found.objects.empty()) {
    return {};
  }
  const Segment& largest = *std::ranges::max_element(found.objects, {}, &Segment::pixels);
  return segment_cloud(image, intrinsics, table, found, largest);
}

void check_rising(std::string_view field, double low, double high, double least, double most) {
  if (!(low >= least && low <= high && high <= most)) {
    throw InputError(fmt::format("{} from {} to {} is out of range ({} to {}, rising)", field, low, high, least, most));
  }
}

}  // namespace

void ViewSettings::validate() const {
  check_rising("size of views", least_size, most_size, 0.01, 10.0);
  check_rising("distance of views", least_distance, most_distance, 0.1, 20.0);
  check_rising("elevation of views", least_elevation, most_elevation, 1.0, 89.0);
  check_rising("noise of views", 0.0, most_noise, 0.0, 10.0);
  if (up == UpAxis::none) {
    throw InputError("views of models need to know which axis points up (x, y or z)");
  }
  segment.validate();
}

PointCloud view_of(const Mesh& model, const ViewSettings& settings, std::uint64_t seed) {
  Random random(seed);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    PointCloud view = one_view(model, settings, random);
    if (!view.points.empty()) {
      return view;
    }
  }
  throw InputError("shows too little to a camera to be an object");
}

}  // namespace spincat
