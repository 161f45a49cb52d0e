#include "spincat/spin/spin_images.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "spincat/spin/in_order.h"
#include "spincat/spin/spin_image_maker.h"

namespace spincat {
namespace {

using Blocks = std::vector<SpinImageBlock>;

// How many blocks are made together: the more, the better their spin points can be put in spatial order; but each of
// the threads that share them out must find some, and memory is bounded. This decides about nothing but speed.
std::size_t blocks_together(std::size_t blocks, const SpinImageShape& shape, std::size_t sharing_threads) {
  constexpr std::size_t kMostBytes = std::size_t{16} << 20;
  constexpr std::size_t kMostBlocks = 256;
  const std::size_t block_bytes = kSpinImageBlock * shape.size() * sizeof(float);
  const std::size_t fair = sharing_threads == 1 ? kMostBlocks : blocks / (8 * sharing_threads);
  return std::max<std::size_t>(std::min({kMostBlocks, kMostBytes / block_bytes, fair}), 1);
}

// Lots of blocks to be filled. The memory of those that are done with is used again: fresh memory costs more than many
// an image.
class BlockStore {
 public:
  BlockStore(std::size_t spin_points, const SpinImageShape& shape) : spin_points_(spin_points), shape_(shape) {}

  // The blocks first, ..., first + count - 1; what their images hold is undefined.
  Blocks take(std::size_t first, std::size_t count) {
    Blocks blocks = spare();
    blocks.resize(count);
    for (std::size_t b = 0; b < count; ++b) {
      blocks[b].first = (first + b) * kSpinImageBlock;
      const std::size_t images = std::min(kSpinImageBlock, spin_points_ - blocks[b].first);
      if (blocks[b].images.count() != images) {
        blocks[b].images = SpinImages(images, shape_);
      }
    }
    return blocks;
  }

  void give_back(Blocks blocks) {
    const std::lock_guard lock(mutex_);
    spare_.push_back(std::move(blocks));
  }

 private:
  Blocks spare() {
    const std::lock_guard lock(mutex_);
    if (spare_.empty()) {
      return {};
    }
    Blocks blocks = std::move(spare_.back());
    spare_.pop_back();
    return blocks;
  }

  std::size_t spin_points_;
  SpinImageShape shape_;
  std::mutex mutex_;  // guards what follows
  std::vector<Blocks> spare_;
};

}  // namespace

void make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points, const SpinImageParams& params,
                      const SpinImageConsumer& consume, int threads) {
  const auto workers = static_cast<std::size_t>(std::max(threads, 1));
  const SpinImageMaker maker(surface, params, threads);
  const std::size_t blocks = (spin_points.size() + kSpinImageBlock - 1) / kSpinImageBlock;
  // With enough blocks every thread makes its own; otherwise all threads work on each.
  const bool share_blocks = blocks >= 4 * workers;
  const std::size_t together = blocks_together(blocks, params.shape(), share_blocks ? workers : 1);
  BlockStore store(spin_points.size(), params.shape());
  const auto make = [&](std::size_t step, std::size_t) {
    const std::size_t first = step * together;
    Blocks made = store.take(first, std::min(together, blocks - first));
    maker.make(spin_points, made, share_blocks ? 1 : threads);
    return made;
  };
  const auto deliver = [&](std::size_t, Blocks& made) {
    std::ranges::for_each(made, consume);
    store.give_back(std::move(made));
  };
  InOrder<Blocks>((blocks + together - 1) / together, share_blocks ? workers : 1, make, deliver);
}

SpinImages make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points,
                            const SpinImageParams& params, int threads) {
  SpinImages all(spin_points.size(), params.shape());
  make_spin_images(
      surface, spin_points, params,
      [&](const SpinImageBlock& block) {
        std::ranges::copy(block.images.values(), all.values().begin() + block.first * params.shape().size());
      },
      threads);
  return all;
}

}  // namespace spincat
