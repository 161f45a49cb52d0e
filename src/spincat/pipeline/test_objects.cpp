#include "spincat/pipeline/test_objects.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <variant>

#include "spincat/error.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/parallel/for_each.h"
#include "spincat/pipeline/stopwatch.h"
#include "spincat/prepare/surface_samples.h"

namespace spincat {
namespace {

constexpr std::uint64_t kTestFormPurpose = 101;  // of derive_seed

Object turned(Object object, Random& random) {
  // Four normal numbers are a random direction in four dimensions: evenly distributed unit quaternions.
  const double w = random.normal();
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  const Eigen::Matrix3d turn = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  const auto turn_all = [&](std::vector<Vec3>& vectors) {
    for (Vec3& v : vectors) {
      v = turn * v;
    }
  };
  if (Mesh* mesh = std::get_if<Mesh>(&object)) {
    turn_all(mesh->vertices);
  } else {
    auto& cloud = std::get<PointCloud>(object);
    turn_all(cloud.points);
    turn_all(cloud.normals);
    if (cloud.sensor) {
      cloud.sensor = turn * *cloud.sensor;
    }
  }
  return object;
}

double diameter(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points) {
    bounds.extend(p);
  }
  double furthest = 0.0;
  for (const Vec3& p : points) {
    furthest = std::max(furthest, (p - bounds.center()).norm());
  }
  return 2.0 * furthest;
}

PointCloud noisy_cloud(const Object& object, const TestOptions& options, Random& random) {
  PointCloud cloud;
  if (const Mesh* mesh = std::get_if<Mesh>(&object)) {
    if (!has_area(*mesh)) {
      throw InputError("has no area to draw a cloud's points from");
    }
    cloud.points = surface_samples(*mesh, static_cast<std::size_t>(options.cloud_points), random).positions;
  } else {
    cloud.points = std::get<PointCloud>(object).points;
    cloud.sensor = std::get<PointCloud>(object).sensor;
  }
  const double amount = options.noise * diameter(cloud.points);
  for (Vec3& p : cloud.points) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      p[axis] += amount * random.normal();
    }
  }
  return cloud;
}

}  // namespace

void TestOptions::validate() const {
  if (!(noise >= 0.0 && noise <= 1.0)) {
    throw InputError(fmt::format("noise {} is out of range (0 to 1)", noise));
  }
  if (cloud_points < 1 || cloud_points > 10'000'000) {
    throw InputError(fmt::format("number of cloud points {} is out of range (1 to 10000000)", cloud_points));
  }
}

Object in_test_form(const Object& object, const TestOptions& options, std::uint64_t seed) {
  Random random(seed);
  switch (options.form) {
    case TestForm::turned:
      return turned(object, random);
    case TestForm::cloud:
      return noisy_cloud(object, options, random);
    case TestForm::as_is:
      break;
  }
  return object;
}

std::span<const float> TestTable::features_of(std::uint32_t object) const {
  return {features.row(object).data(), static_cast<std::size_t>(features.cols())};
}

TestTable describe_tested(std::span<const DatasetObject> objects, std::size_t feature_length, const Settings& settings,
                          const TestOptions& options, int threads, const Progress& progress) {
  TestTable table;
  table.objects.assign(objects.begin(), objects.end());
  table.features.setZero(static_cast<Eigen::Index>(objects.size()), static_cast<Eigen::Index>(feature_length));
  table.problems.resize(objects.size());
  const std::uint64_t stream = derive_seed(settings.seed, kTestFormPurpose);
  std::mutex mutex;
  std::size_t done = 0;
  for_each_index(objects.size(), threads, [&](std::size_t i) {
    StageSeconds seconds;
    try {
      Stopwatch watch;
      const Object object = in_test_form(read_object(objects[i].file), options, derive_seed(stream, i));
      seconds.read = watch.lap();
      const FeatureVector found = describe(object, settings, 0, &seconds);
      if (found.values.size() == feature_length) {
        std::ranges::copy(found.values, table.features.row(static_cast<Eigen::Index>(i)).data());
      } else {
        table.problems[i] =
            fmt::format("gives {} features where the judges expect {}", found.values.size(), feature_length);
      }
    } catch (const InputError& error) {
      table.problems[i] = error.problem();
    }
    const std::lock_guard lock(mutex);
    table.seconds += seconds;
    ++done;
    if (progress) {
      progress("describing test objects", done, objects.size());
    }
  });
  return table;
}

}  // namespace spincat
