#include "spincat/pipeline/describe.h"

#include <memory>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/geometry/random.h"
#include "spincat/pipeline/stopwatch.h"
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

Preparation prepare_shape(const Object& shape, const Settings& settings, std::uint64_t seed) {
  Preparation result{prepare(shape, settings.prepare, seed), settings.spin};
  result.params.bin_size = prepared_bin_size(shape, result.object, settings);
  result.params.validate();  // an absolute size may vanish beside a huge object
  return result;
}

}  // namespace

Preparation prepare_object(const Object& object, const Settings& settings, int copy) {
  // A copy gets points of its own: another look at another shape.
  const std::uint64_t seed = derive_seed(settings.seed, static_cast<std::uint64_t>(copy));
  if (copy > 0) {
    return prepare_shape(stretched_copy(object, copy, settings.stretch, settings.seed), settings, seed);
  }
  return prepare_shape(object, settings, seed);
}

FeatureVector describe(const Object& object, const Settings& settings, int copy, StageSeconds* seconds) {
  StageSeconds spent;
  Stopwatch watch;
  const auto [prepared, params] = prepare_object(object, settings, copy);
  spent.prepare = watch.lap();

  const std::unique_ptr<Encoding> encoding = make_encoding(settings.encoding);
  const auto object_sums = encoding->begin(prepared.surface, prepared.spin_points, params);
  std::vector<double> sums(object_sums->size(), 0.0);
  spent.encode = watch.lap();
  make_spin_images(prepared.surface, prepared.spin_points, params, [&](const SpinImageBlock& block) {
    spent.spin += watch.lap();
    object_sums->accumulate(block, sums);
    spent.encode += watch.lap();
  });
  FeatureVector features = object_sums->finish(sums);
  spent.encode += watch.lap();
  if (seconds != nullptr) {
    *seconds += spent;
  }
  return features;
}

}  // namespace spincat
