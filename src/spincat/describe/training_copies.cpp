#include "spincat/describe/training_copies.h"

#include <bit>
#include <cstddef>
#include <variant>

#include "spincat/camera/render/views.h"
#include "spincat/describe/describe.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/as_cloud.h"
#include "spincat/prepare/prepare.h"

namespace spincat {
namespace {

constexpr double kCloudNoise = 0.01;  // of the diameter

// What the random numbers of a copy are for (derive_seed's purpose).
enum Purpose : std::uint64_t { kCloud = 200, kView = 202 };

// A number of the mesh itself. From the same places, models that face the same way would look more alike than they are.
std::uint64_t seed_of(const Mesh& mesh) {
  std::uint64_t seed = mesh.triangles.size();
  for (const Vec3& v : mesh.vertices) {
    for (const double x : v) {
      seed = derive_seed(seed, std::bit_cast<std::uint64_t>(x));
    }
  }
  return seed;
}

PointCloud view_number(const Mesh& mesh, const Settings& settings, int view) {
  ViewSettings view_settings;
  view_settings.up = settings.up;
  const std::uint64_t seed = derive_seed(derive_seed(settings.seed, kView), seed_of(mesh));
  return view_of(mesh, view_settings, derive_seed(seed, static_cast<std::uint64_t>(view)));
}

// Every other cloud is exact, the others are as noisy as a good scan is at worst.
Object stretched_cloud(const Object& shape, const Settings& settings, int k) {
  const double noise = (k - settings.copies) % 2 == 1 ? kCloudNoise : 0.0;
  const std::uint64_t seed = derive_seed(derive_seed(settings.seed, kCloud), static_cast<std::uint64_t>(k));
  return as_cloud(shape, static_cast<std::size_t>(settings.prepare.points), noise, seed);
}

Object shape_of_copy(const Object& object, const Settings& settings, int k) {
  if (settings.trained_for == TrainedFor::views) {
    const Mesh* const mesh = std::get_if<Mesh>(&object);
    return mesh != nullptr ? Object(view_number(*mesh, settings, k)) : object;
  }
  if (k == 0) {
    return object;
  }
  Object shape = stretched_copy(object, k, settings.stretch, settings.seed);
  return k <= settings.copies ? shape : stretched_cloud(shape, settings, k);
}

}  // namespace

TrainingCopy training_copy(const Object& object, const Settings& settings, int k) {
  return {shape_of_copy(object, settings, k), points_seed(settings, k)};
}

std::optional<Object> shown_instead(const Object& object, const Settings& settings) {
  const bool sees_views = settings.trained_for == TrainedFor::views && std::holds_alternative<Mesh>(object);
  return sees_views ? std::optional(shape_of_copy(object, settings, 0)) : std::nullopt;
}

}  // namespace spincat
