#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <variant>
#include <vector>

#include "harness.h"
#include "sections.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/prepare/normals.h"
#include "spincat/prepare/resolution.h"
#include "spincat/spin/reference.h"
#include "spincat/spin/spin_images.h"
#ifdef SPINCAT_BENCH_PCL
#include "pcl_spin.h"
#endif

namespace spincat::bench {
namespace {

struct Cloud {
  OrientedPoints points;
  double edge = 0.0;      // mean distance of neighbours
  double diagonal = 0.0;  // of the bounding box
};

double diagonal_of(const OrientedPoints& points) {
  Eigen::Vector3f low = points.position(0);
  Eigen::Vector3f high = low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    low = low.cwiseMin(points.position(i));
    high = high.cwiseMax(points.position(i));
  }
  return static_cast<double>((high - low).norm());
}

// Uniform random points of a torus with radii 1 and 0.4, in no order.
Cloud torus(std::size_t count) {
  Random random(5);
  Cloud cloud{OrientedPoints(count)};
  for (std::size_t i = 0; i < count;) {
    const double around = 2.0 * std::numbers::pi * random.uniform();
    const double across = 2.0 * std::numbers::pi * random.uniform();
    const double ring = 1.0 + 0.4 * std::cos(across);
    if (1.4 * random.uniform() > ring) {
      continue;
    }
    const Eigen::Vector3d n(std::cos(around) * std::cos(across), std::sin(around) * std::cos(across), std::sin(across));
    const Eigen::Vector3d p(ring * std::cos(around), ring * std::sin(around), 0.4 * std::sin(across));
    cloud.points.set(i++, p.cast<float>(), n.cast<float>());
  }
  const double area = 4.0 * std::numbers::pi * std::numbers::pi * 0.4;
  cloud.edge = std::sqrt(area / static_cast<double>(count));
  cloud.diagonal = diagonal_of(cloud.points);
  return cloud;
}

std::optional<Cloud> read_scan(const std::filesystem::path& file) {
  if (file.empty()) {
    return {};
  }
  const Mesh mesh = std::get<Mesh>(read_object(file));
  const std::vector<Vec3> normals = vertex_normals(mesh);
  Cloud cloud{OrientedPoints(mesh.vertices.size()), mesh_resolution(mesh)};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    cloud.points.set(i, mesh.vertices[i].cast<float>(), normals[i].cast<float>());
  }
  cloud.diagonal = diagonal_of(cloud.points);
  return cloud;
}

OrientedPoints some_of(const OrientedPoints& points, const std::vector<int>& chosen) {
  OrientedPoints result(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    result.set(k, points.position(static_cast<std::size_t>(chosen[k])),
               points.normal(static_cast<std::size_t>(chosen[k])));
  }
  return result;
}

std::vector<int> every(std::size_t step, std::size_t count) {
  std::vector<int> chosen;
  for (std::size_t i = 0; i < count; i += step) {
    chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

// One race: images of `chosen` points (all if empty), search radius and angle as PCL counts them.
struct Case {
  const Cloud& cloud;
  std::vector<int> chosen;
  int image_width;
  double search_radius;
  double angle;
};

SpinImageParams params_of(const Case& it) {
  SpinImageParams params;
  params.convention = SpinConvention::pcl;
  params.image_width = it.image_width;
  params.bin_size = pcl_bin_size(it.search_radius, it.image_width);
  params.support_angle = it.angle;
  return params;
}

nlohmann::ordered_json race_case(const Case& it, int rounds) {
  const OrientedPoints spin_points = it.chosen.empty() ? it.cloud.points : some_of(it.cloud.points, it.chosen);
  const SpinImageParams pcl_params = params_of(it);
  SpinImageParams johnson = pcl_params;
  johnson.convention = SpinConvention::johnson;
  johnson.support_angle = it.angle >= 90.0 ? 180.0 : it.angle;
  const auto images = static_cast<double>(spin_points.size());
  const auto ours = [&](const SpinImageParams& params, int threads) {
    return [&it, &spin_points, params, threads] {
      make_spin_images(
          it.cloud.points, spin_points, params, [](const SpinImageBlock&) {}, threads);
    };
  };
  std::vector<float> image(pcl_params.shape().size());
  std::vector<Contestant> contestants = {
      {"spincat", images, ours(pcl_params, 1)},
      {"spincat_johnson", images, ours(johnson, 1)},
      {"spincat_2_threads", images, ours(pcl_params, 2)},
      {"reference", 1.0, [&] { spin_image_reference(it.cloud.points, spin_points, 0, pcl_params, image); }}};
#ifdef SPINCAT_BENCH_PCL
  const PclSpinImages pcl(it.cloud.points);
  // PCL takes a run of neighbours in the file where we take all points: the rest of the hour is better used.
  const std::vector<int> for_pcl = it.chosen.empty() ? every(1, 2000) : it.chosen;
  const double least_cosine = it.angle >= 90.0 ? 0.0 : std::cos(it.angle * std::numbers::pi / 180.0);
  contestants.push_back({"pcl", static_cast<double>(for_pcl.size()),
                         [&] { pcl.run(for_pcl, it.image_width, it.search_radius, least_cosine); }});
#endif
  nlohmann::ordered_json result = race(contestants, rounds);
  result["points"] = it.cloud.points.size();
  result["pairs_per_second"] =
      result["spincat"]["per_second"].get<double>() * static_cast<double>(it.cloud.points.size());
  if (result.contains("pcl")) {
    result["times_pcl"] = result["spincat"]["per_second"].get<double>() / result["pcl"]["per_second"].get<double>();
  }
  result["two_threads_gain"] =
      result["spincat_2_threads"]["per_second_wall"].get<double>() / result["spincat"]["per_second_wall"].get<double>();
  return result;
}

}  // namespace

nlohmann::ordered_json spin_race(const std::filesystem::path& scan, int rounds) {
  nlohmann::ordered_json result;
  if (const std::optional<Cloud> cloud = read_scan(scan)) {
    const std::vector<int> hundred = every(cloud->points.size() / 100 + 1, cloud->points.size());
    result["scan, whole object, 60"] = race_case({*cloud, hundred, 20, cloud->diagonal, 60.0}, rounds);
    result["scan, whole object, 180"] = race_case({*cloud, hundred, 20, cloud->diagonal, 90.0}, rounds);
    result["scan, local, 60"] = race_case({*cloud, {}, 10, 20.0 * cloud->edge, 60.0}, rounds);
  }
  for (const std::size_t size : {std::size_t{50'000}, std::size_t{500'000}}) {
    const Cloud cloud = torus(size);
    const std::string name = "torus " + std::to_string(size / 1000) + "k, ";
    const std::vector<int> hundred = every(size / 100, size);
    result[name + "whole object, 180"] = race_case({cloud, hundred, 20, cloud.diagonal, 90.0}, rounds);
    result[name + "local, 180"] = race_case({cloud, {}, 10, 20.0 * cloud.edge, 90.0}, rounds);
  }
  return result;
}

}  // namespace spincat::bench
