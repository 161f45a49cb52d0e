#include "spincat/spin/spin_images.h"

#include <algorithm>

#include "spincat/spin/in_order.h"
#include "spincat/spin/spin_image_maker.h"

namespace spincat {
namespace {

// How threads share the work. With few blocks and a large surface they share out the surface, one block after the
// other, as the images of a block are too few to keep them busy.
struct Sharing {
  std::size_t block_threads;    // blocks made at the same time
  std::size_t surface_threads;  // threads within a block
};

Sharing share_out(std::size_t blocks, std::size_t surface_pieces, int threads) {
  const auto wanted = static_cast<std::size_t>(std::max(threads, 1));
  constexpr std::size_t kFewPieces = 8;  // a thread's share below which sharing the surface costs more than it brings
  if (blocks < 2 * wanted && surface_pieces >= kFewPieces * wanted) {
    return {1, wanted};
  }
  return {std::clamp<std::size_t>(blocks, 1, wanted), 1};
}

}  // namespace

void make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points, const SpinImageParams& params,
                      const SpinImageConsumer& consume, int threads) {
  const SpinImageMaker maker(surface, params);
  const std::size_t blocks = (spin_points.size() + kSpinImageBlock - 1) / kSpinImageBlock;
  const Sharing sharing = share_out(blocks, maker.surface_pieces(), threads);
  const auto make = [&](std::size_t step, std::size_t) {
    const std::size_t first = step * kSpinImageBlock;
    SpinImageBlock block{first, SpinImages(std::min(kSpinImageBlock, spin_points.size() - first), params.shape())};
    maker.make(spin_points, first, block.images.values(), sharing.surface_threads);
    return block;
  };
  InOrder<SpinImageBlock>(blocks, sharing.block_threads, make,
                          [&](std::size_t, SpinImageBlock& block) { consume(block); });
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
