#include "spincat/describe/describe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "spincat/describe/stopwatch.h"
#include "spincat/encode/block_sums.h"
#include "spincat/encode/encoding.h"
#include "spincat/geometry/mean_position.h"
#include "spincat/geometry/random.h"
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

constexpr std::uint64_t kDraw = 201;  // derive_seed's purpose

// Every draw gets points of its own.
std::uint64_t seed_of_draw(std::uint64_t seed, int draw) {
  return draw == 0 ? seed : derive_seed(derive_seed(seed, kDraw), static_cast<std::uint64_t>(draw));
}

// One of the parts of a feature vector: which points, and which way the axes of the spin images point.
struct Part {
  SurfaceKind surface;
  SpinAxes axes;
};

SpinAxes up_axes(UpAxis up) {
  return up == UpAxis::x ? SpinAxes::x : up == UpAxis::y ? SpinAxes::y : SpinAxes::z;
}

// Parts of the same points stand side by side, so that the points are made once.
std::vector<Part> parts_of(const Settings& settings) {
  std::vector<Part> parts = {{settings.prepare.surface, SpinAxes::normals}};
  if (settings.radial) {
    parts.push_back({settings.prepare.surface, SpinAxes::radial});
  }
  if (settings.up != UpAxis::none) {
    const UpAxis up = settings.trained_for == TrainedFor::views ? UpAxis::z : settings.up;
    parts.push_back({settings.prepare.surface, up_axes(up)});
  }
  if (settings.plain_samples) {
    parts.push_back({SurfaceKind::samples, SpinAxes::normals});
  }
  return parts;
}

// A spin point at the very middle keeps its normal.
void turn_outwards(const Eigen::Vector3f& middle, OrientedPoints& spin_points) {
  for (std::size_t i = 0; i < spin_points.size(); ++i) {
    const Eigen::Vector3f outwards = spin_points.position(i) - middle;
    if (outwards.squaredNorm() > 0.0F) {
      spin_points.set(i, spin_points.position(i), outwards.stableNormalized());
    }
  }
}

void turn_upwards(SpinAxes up, OrientedPoints& spin_points) {
  const Eigen::Vector3f axis = Eigen::Vector3f::Unit(static_cast<int>(up) - static_cast<int>(SpinAxes::x));
  for (std::size_t i = 0; i < spin_points.size(); ++i) {
    spin_points.set(i, spin_points.position(i), axis);
  }
}

void turn_axes(SpinAxes axes, PreparedObject& object) {
  if (axes == SpinAxes::radial) {
    turn_outwards(mean_position(object.surface).cast<float>(), object.spin_points);
  } else if (axes != SpinAxes::normals) {
    turn_upwards(axes, object.spin_points);
  }
}

Preparation prepare_part(const Object& shape, const Settings& settings, const Part& part, std::uint64_t seed) {
  PrepareSettings prepare_settings = settings.prepare;
  prepare_settings.surface = part.surface;
  Preparation result{prepare(shape, prepare_settings, seed), settings.spin};
  turn_axes(part.axes, result.object);
  result.params.bin_size = prepared_bin_size(shape, result.object, settings);
  result.params.validate();  // an absolute size may vanish beside a huge object
  return result;
}

// Whether the points of `next` are those of `part`, but for the axes.
bool same_points(const Part& part, const Part& next) {
  return part.surface == next.surface;
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

std::string_view name_of(SpinAxes axes) {
  constexpr std::array<std::string_view, 5> kNames = {"normals", "radial", "x", "y", "z"};
  return kNames[static_cast<std::size_t>(axes)];
}

std::uint64_t points_seed(const Settings& settings, int k) {
  return derive_seed(settings.seed, static_cast<std::uint64_t>(k));
}

Preparation prepare_object(const Object& object, const Settings& settings, std::uint64_t seed) {
  return prepare_part(object, settings, parts_of(settings)[0], seed);
}

std::vector<PreparedPart> prepare_parts(const Object& object, const Settings& settings) {
  const std::vector<Part> parts = parts_of(settings);
  const float factor = 1.0F / std::sqrt(static_cast<float>(parts.size())) / static_cast<float>(settings.draws);
  std::vector<PreparedPart> prepared;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (int draw = 0; draw < settings.draws; ++draw) {
      prepared.push_back({prepare_part(object, settings, parts[p], seed_of_draw(points_seed(settings), draw)),
                          parts[p].surface, parts[p].axes, p, factor});
    }
  }
  return prepared;
}

FeatureVector describe(const Object& object, const Settings& settings, std::uint64_t seed, StageSeconds* seconds,
                       const EncodePrepared& encoder) {
  StageSeconds spent;
  Stopwatch watch;
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
        turn_axes(part.axes, preparation.object);
      } else {
        preparation = prepare_part(object, settings, part, seed_of_draw(seed, draw));
      }
      spent.prepare += watch.lap();
      FeatureVector drawn = encoder ? encoder(preparation) : encoded(preparation, *encoding, watch, spent);
      spent.spin += watch.lap();  // with an encoder of the caller: encoding too, they cannot be told apart
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
