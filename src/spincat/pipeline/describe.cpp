#include "spincat/pipeline/describe.h"

#include <memory>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/error.h"
#include "spincat/geometry/random.h"
#include "spincat/pipeline/stopwatch.h"
#include "spincat/prepare/prepare.h"
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

double prepared_bin_size(const PreparedObject& object, const Settings& settings) {
  switch (settings.bin_size_unit) {
    case BinSizeUnit::absolute:
      return settings.spin.bin_size * object.scale;
    case BinSizeUnit::resolution:
      if (!(object.resolution > 0.0)) {
        throw InputError("has no mesh resolution to measure the bin size in");
      }
      return settings.spin.bin_size * object.resolution;
    case BinSizeUnit::relative:
      break;
  }
  return settings.spin.bin_size;  // the prepared object's radius is 1
}

FeatureVector describe(const Object& object, const Settings& settings, int copy, StageSeconds* seconds) {
  StageSeconds spent;
  Stopwatch watch;
  // A copy gets points of its own: another look at another shape.
  const std::uint64_t seed = derive_seed(settings.seed, static_cast<std::uint64_t>(copy));
  const PreparedObject prepared =
      copy == 0 ? prepare(object, settings.prepare, seed)
                : prepare(stretched_copy(object, copy, settings.stretch, settings.seed), settings.prepare, seed);
  SpinImageParams params = settings.spin;
  params.bin_size = prepared_bin_size(prepared, settings);
  params.validate();  // an absolute size may vanish beside a huge object
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
