#include "spincat/spin/spin_images.h"

#include <algorithm>

#include "spincat/spin/reference.h"

namespace spincat {

void make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points, const SpinImageParams& params,
                      const SpinImageConsumer& consume) {
  for (std::size_t first = 0; first < spin_points.size(); first += kSpinImageBlock) {
    const std::size_t count = std::min(kSpinImageBlock, spin_points.size() - first);
    SpinImageBlock block{first, SpinImages(count, params.shape())};
    for (std::size_t k = 0; k < count; ++k) {
      spin_image_reference(surface, spin_points, first + k, params, block.images.image(k));
    }
    consume(block);
  }
}

SpinImages make_spin_images(const OrientedPoints& surface, const OrientedPoints& spin_points,
                            const SpinImageParams& params) {
  SpinImages all(spin_points.size(), params.shape());
  make_spin_images(surface, spin_points, params, [&](const SpinImageBlock& block) {
    for (std::size_t k = 0; k < block.images.count(); ++k) {
      std::ranges::copy(block.images.image(k), all.image(block.first + k).begin());
    }
  });
  return all;
}

}  // namespace spincat
