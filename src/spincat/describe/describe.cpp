#include "spincat/describe/describe.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "spincat/camera/render/views.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/encode/block_sums.h"
#include "spincat/encode/encoding.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/as_cloud.h"
#include "spincat/prepare/prepare.h"
#include "spincat/prepare/resolution.h"
#include "spincat/spin/spin_images.h"

namespace spincat {

StageSeconds& StageSeconds::operator+=(const StageSeconds& other) {
  read += other.read;
  prepare += other.prepare;
  spin += other.spin;
  encode += other.encode;
  judge += other.judge;
  return *this;
}

namespace {

constexpr double kCloudNoise = 0.01;  // of the diameter

// The bin size in the unit of prepared points. `given` is the object they were made of.
double prepared_bin_size(const Object& given, const PreparedObject& prepared, const Settings& settings) {
  switch (settings.bin_size_unit) {
    case BinSizeUnit::absolute:
      return settings.spin.bin_size * prepared.scale;
    case BinSizeUnit::resolution:
      return settings.spin.bin_size * object_resolution(given) * prepared.scale;
    case BinSizeUnit::relative:
      break;
  }
  return settings.spin.bin_size;  // the prepared object's radius is 1
}

// What the random numbers of an object are for (derive_seed's purpose).
enum Purpose : std::uint64_t { kCloud = 200, kDraw = 201, kView = 202 };

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

// What copy number `copy` of an object is: stretched, or stretched and turned into a cloud, or a view. Nothing where it
// is the object itself.
std::optional<Object> shape_of_copy(const Object& object, const Settings& settings, int copy) {
  if (settings.trained_for == TrainedFor::views) {
    const Mesh* const mesh = std::get_if<Mesh>(&object);
    return mesh != nullptr ? std::optional<Object>(view_number(*mesh, settings, copy)) : std::nullopt;
  }
  if (copy == 0) {
    return std::nullopt;
  }
  Object shape = stretched_copy(object, copy, settings.stretch, settings.seed);
  if (copy <= settings.copies) {
    return shape;
  }
  // Every other cloud is exact, the others are as noisy as a good scan is at worst.
  const double noise = (copy - settings.copies) % 2 == 1 ? kCloudNoise : 0.0;
  const std::uint64_t seed = derive_seed(derive_seed(settings.seed, kCloud), static_cast<std::uint64_t>(copy));
  return as_cloud(shape, static_cast<std::size_t>(settings.prepare.points), noise, seed);
}

// A copy gets points of its own: another look at another shape. So does every draw.
std::uint64_t seed_of(const Settings& settings, int copy, int draw) {
  const std::uint64_t seed = derive_seed(settings.seed, static_cast<std::uint64_t>(copy));
  return draw == 0 ? seed : derive_seed(derive_seed(seed, kDraw), static_cast<std::uint64_t>(draw));
}

// One of the parts of a feature vector: which points, and which way the axes of the spin images point.
struct Part {
  SurfaceKind surface;
  UpAxis axes;  // none: along the normals
};

std::vector<Part> parts_of(const Settings& settings) {
  std::vector<Part> parts = {{settings.prepare.surface, UpAxis::none}};
  if (settings.plain_samples) {
    parts.push_back({SurfaceKind::samples, UpAxis::none});
  }
  if (settings.up != UpAxis::none) {
    const UpAxis up = settings.trained_for == TrainedFor::views ? UpAxis::z : settings.up;
    parts.push_back({settings.prepare.surface, up});
  }
  return parts;
}

void turn_axes(UpAxis up, OrientedPoints& spin_points) {
  if (up == UpAxis::none) {
    return;
  }
  const Eigen::Vector3f axis = Eigen::Vector3f::Unit(static_cast<int>(up) - static_cast<int>(UpAxis::x));
  for (std::size_t i = 0; i < spin_points.size(); ++i) {
    spin_points.set(i, spin_points.position(i), axis);
  }
}

Preparation prepare_part(const Object& shape, const Settings& settings, const Part& part, std::uint64_t seed) {
  PrepareSettings prepare_settings = settings.prepare;
  prepare_settings.surface = part.surface;
  Preparation result{prepare(shape, prepare_settings, seed), settings.spin};
  turn_axes(part.axes, result.object.spin_points);
  result.params.bin_size = prepared_bin_size(shape, result.object, settings);
  result.params.validate();  // an absolute size may vanish beside a huge object
  return result;
}

// Whether the points of `next` are those of `part`, but for the axes.
bool same_points(const Part& part, const Part& next) {
  return part.surface == next.surface && part.axes == UpAxis::none;
}

FeatureVector encoded(const Preparation& preparation, const Encoding& encoding, Stopwatch& watch, StageSeconds& spent) {
  const auto& [prepared, params] = preparation;
  const auto object_sums = encoding.begin(prepared.surface, prepared.spin_points, params);
  BlockSums sums(*object_sums);
  spent.encode += watch.lap();
  make_spin_images(prepared.surface, prepared.spin_points, params, [&](const SpinImageBlock& block) {
    spent.spin += watch.lap();
    sums.add(block);
    spent.encode += watch.lap();
  });
  FeatureVector features = object_sums->finish(sums.finish().total());
  spent.encode += watch.lap();
  return features;
}

// Appends the part's blocks and values, these times `factor`.
void append(const FeatureVector& part, float factor, FeatureVector& whole) {
  for (const float value : part.values) {
    whole.values.push_back(value * factor);
  }
  whole.blocks.insert(whole.blocks.end(), part.blocks.begin(), part.blocks.end());
  whole.encoding = part.encoding;
  whole.local_size = part.local_size;
}

}  // namespace

Preparation prepare_object(const Object& object, const Settings& settings, int copy) {
  const std::optional<Object> changed = shape_of_copy(object, settings, copy);
  return prepare_part(changed ? *changed : object, settings, parts_of(settings)[0], seed_of(settings, copy, 0));
}

std::vector<PreparedPart> prepare_parts(const Object& object, const Settings& settings) {
  const std::vector<Part> parts = parts_of(settings);
  const float factor = 1.0F / std::sqrt(static_cast<float>(parts.size())) / static_cast<float>(settings.draws);
  std::vector<PreparedPart> prepared;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (int draw = 0; draw < settings.draws; ++draw) {
      prepared.push_back({prepare_part(object, settings, parts[p], seed_of(settings, 0, draw)), parts[p].surface,
                          parts[p].axes, p, factor});
    }
  }
  return prepared;
}

FeatureVector describe(const Object& object, const Settings& settings, int copy, StageSeconds* seconds,
                       const EncodePrepared& elsewhere) {
  StageSeconds spent;
  Stopwatch watch;
  const std::optional<Object> changed = shape_of_copy(object, settings, copy);
  const Object& shape = changed ? *changed : object;
  const std::unique_ptr<Encoding> encoding = make_encoding(settings.encoding);
  const std::vector<Part> parts = parts_of(settings);
  const float factor = 1.0F / std::sqrt(static_cast<float>(parts.size()));
  FeatureVector whole;
  Preparation preparation;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    FeatureVector mean;
    for (int draw = 0; draw < settings.draws; ++draw) {
      if (settings.draws == 1 && k > 0 && same_points(parts[k - 1], part)) {
        turn_axes(part.axes, preparation.object.spin_points);
      } else {
        preparation = prepare_part(shape, settings, part, seed_of(settings, copy, draw));
      }
      spent.prepare += watch.lap();
      FeatureVector drawn = elsewhere ? elsewhere(preparation) : encoded(preparation, *encoding, watch, spent);
      spent.spin += watch.lap();  // elsewhere: with encoding, they cannot be told apart
      if (draw == 0) {
        mean = std::move(drawn);
      } else {
        std::ranges::transform(mean.values, drawn.values, mean.values.begin(), std::plus<>());
      }
    }
    append(mean, factor / static_cast<float>(settings.draws), whole);
  }
  if (seconds != nullptr) {
    *seconds += spent;
  }
  return whole;
}

}  // namespace spincat
