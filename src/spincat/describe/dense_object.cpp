#include "spincat/describe/dense_object.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "spincat/describe/packed_points.h"
#include "spincat/describe/packed_sums.h"
#include "spincat/encode/block_sums.h"
#include "spincat/encode/encoding.h"
#include "spincat/parallel/packing.h"
#include "spincat/spin/spin_image_maker.h"

namespace spincat {
namespace {

// What other ranks have of an object.
struct OwnedObject {
  OrientedPoints surface;
  OrientedPoints spin_points;
  SpinImageParams params;
};

template <class T>
concept PointsToSpin = MessageOf<T, DenseObject> || MessageOf<T, OwnedObject>;

}  // namespace

void fields(auto& archive, PointsToSpin auto& object) {
  auto& [surface, spin_points, params] = object;  // does not compile when a member is forgotten
  archive(surface, spin_points, params);
}

namespace {

constexpr std::size_t kTasksPerThread = 64;               // so that the last tasks keep nobody waiting for long
constexpr std::size_t kMostBytes = std::size_t{8} << 20;  // of a task's images
constexpr std::size_t kBlocksAtOnce = 16;                 // of images that are encoded where they are made

// Spin points whose images are one task: `first` to `end` - 1.
struct Run {
  std::uint64_t first = 0;
  std::uint64_t end = 0;
};

void fields(auto& archive, MessageOf<Run> auto& run) {
  auto& [first, end] = run;
  archive(first, end);
}

// Runs of spin points, each a whole subtree of leaves.
struct Runs {
  Runs(const DenseObject& object, int threads) : spin_points(object.spin_points.size()) {
    const std::size_t image_bytes = object.params.shape().size() * sizeof(float);
    const std::size_t fair = spin_points / (kTasksPerThread * static_cast<std::size_t>(threads));
    while (2 * length <= fair && 2 * length * image_bytes <= kMostBytes) {
      length *= 2;
    }
  }

  std::size_t count() const { return (spin_points + length - 1) / length; }
  std::string task(std::size_t i) const { return pack(Run{i * length, std::min(spin_points, (i + 1) * length)}); }

  std::size_t spin_points;
  std::size_t length = kLeafPoints;
};

std::string images_of(const SpinImageMaker& maker, const OrientedPoints& spin_points, std::string_view task) {
  const auto run = unpack<Run>(task);
  std::string bytes((run.end - run.first) * maker.shape().size() * sizeof(float), '\0');
  maker.make(spin_points, run.first, {reinterpret_cast<float*>(bytes.data()), bytes.size() / sizeof(float)});
  return bytes;
}

std::string sums_of(const SpinImageMaker& maker, const OrientedPoints& spin_points,
                    const Encoding::ObjectSums& object_sums, std::string_view task) {
  const auto run = unpack<Run>(task);
  BlockSums sums(object_sums);
  std::vector<SpinImageBlock> blocks;
  for (std::size_t first = run.first; first < run.end;) {
    blocks.clear();
    while (first < run.end && blocks.size() < kBlocksAtOnce) {
      const std::size_t count = std::min(kSpinImageBlock, run.end - first);
      blocks.push_back({first, SpinImages(count, maker.shape())});
      first += count;
    }
    maker.make(spin_points, blocks);
    for (const SpinImageBlock& block : blocks) {
      sums.add(block);
    }
  }
  return pack_sums(sums.finish());
}

// Images that came as bytes, block by block.
void for_each_block(std::size_t first, std::span<const float> images, const SpinImageShape& shape,
                    const SpinImageConsumer& consume) {
  const std::size_t count = images.size() / shape.size();
  for (std::size_t k = 0; k < count; k += kSpinImageBlock) {
    SpinImageBlock block{first + k, SpinImages(std::min(kSpinImageBlock, count - k), shape)};
    std::ranges::copy(images.subspan(k * shape.size(), block.images.values().size()), block.images.values().begin());
    consume(block);
  }
}

std::span<const float> as_floats(const std::string& bytes) {
  return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
}

using ConsumeImages = std::function<void(std::size_t first, std::span<const float> images)>;

void make_images(TaskFarm& farm, const DenseObject& object, bool in_journal, const ConsumeImages& consume,
                 const TaskFarm::Tick& tick) {
  const SpinImageMaker maker(object.surface, object.params);
  const Runs runs(object, farm.threads_everywhere());
  Job job;
  job.kind = kImagesTasks;
  job.context = [&](Packer& packer) { packer(object); };
  job.work = [&](std::string_view task) { return images_of(maker, object.spin_points, task); };
  job.tasks = runs.count();
  job.task = [&](std::size_t i) { return runs.task(i); };
  job.deliver = [&](std::size_t i, const std::string& result) { consume(i * runs.length, as_floats(result)); };
  job.in_journal = in_journal;
  farm.run(job, [&](std::size_t done) {
    if (tick) {
      tick(std::min(done * runs.length, object.spin_points.size()));
    }
  });
}

}  // namespace

Work make_images_work(std::string_view context) {
  const auto object = std::make_shared<const OwnedObject>(unpack<OwnedObject>(context));
  const auto maker = std::make_shared<const SpinImageMaker>(object->surface, object->params);
  return [object, maker](std::string_view task) { return images_of(*maker, object->spin_points, task); };
}

Work make_sums_work(std::string_view context) {
  Unpacker unpacker(context);
  const auto encoding = unpacker.next<std::string_view>();
  const auto object = std::make_shared<const OwnedObject>(unpacker.next<OwnedObject>());
  const auto maker = std::make_shared<const SpinImageMaker>(object->surface, object->params);
  const std::shared_ptr<const Encoding::ObjectSums> sums =
      make_encoding(encoding)->begin(object->surface, object->spin_points, object->params);
  return [object, maker, sums](std::string_view task) { return sums_of(*maker, object->spin_points, *sums, task); };
}

void make_spin_images(TaskFarm& farm, const DenseObject& object,
                      const std::function<void(std::size_t first, std::span<const float> images)>& consume,
                      const TaskFarm::Tick& tick) {
  make_images(farm, object, true, consume, tick);
}

FeatureVector encode_object(TaskFarm& farm, const DenseObject& object, std::string_view encoding_name, WorkSplit split,
                            const TaskFarm::Tick& tick) {
  const auto encoding = make_encoding(encoding_name);
  encoding->check(object.params);
  const std::unique_ptr<Encoding::ObjectSums> object_sums =
      encoding->begin(object.surface, object.spin_points, object.params);
  if (split == WorkSplit::return_images || !encoding->pools() || object.spin_points.empty()) {
    BlockSums sums(*object_sums);
    const auto add = [&](const SpinImageBlock& block) { sums.add(block); };
    // Not in the journal: gigabytes of images that nobody asked for, to save a feature vector.
    make_images(
        farm, object, false,
        [&](std::size_t first, std::span<const float> images) {
          for_each_block(first, images, object.params.shape(), add);
        },
        tick);
    return object_sums->finish(sums.finish().total());
  }
  const SpinImageMaker maker(object.surface, object.params);
  const Runs runs(object, farm.threads_everywhere());
  SumsTree sums;
  Job job;
  job.kind = kSumsTasks;
  job.context = [&](Packer& packer) { packer(encoding_name, object); };
  job.work = [&](std::string_view task) { return sums_of(maker, object.spin_points, *object_sums, task); };
  job.tasks = runs.count();
  job.task = [&](std::size_t i) { return runs.task(i); };
  job.deliver = [&](std::size_t, const std::string& result) { unpack_sums(result, sums); };
  farm.run(job, [&](std::size_t done) {
    if (tick) {
      tick(std::min(done * runs.length, object.spin_points.size()));
    }
  });
  return object_sums->finish(sums.total());
}

}  // namespace spincat
