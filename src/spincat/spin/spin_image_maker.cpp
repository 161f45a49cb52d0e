#include "spincat/spin/spin_image_maker.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "spincat/geometry/aligned.h"
#include "spincat/spin/in_order.h"
#include "spincat/spin/kernel.h"
#include "spincat/spin/support.h"
#include "spincat/spin/surface_groups.h"

namespace spincat {
namespace {

using Sums = std::vector<std::int64_t, AlignedAllocator<std::int64_t>>;
using TileList = std::vector<std::uint32_t>;

// Images under way at a time, and tiles of the surface that pass through the cache for all of them: together about half
// of a usual second-level cache.
constexpr std::size_t kMostImages = 16;
constexpr std::size_t kSumsBytes = 384 * 1024;
constexpr std::size_t kTilesInCache = 8;

SpinPoint spin_point(const OrientedPoints& points, std::size_t k) {
  return {points.x()[k], points.y()[k], points.z()[k], points.nx()[k], points.ny()[k], points.nz()[k]};
}

}  // namespace

class SpinImageMaker::Engine {
 public:
  Engine(const OrientedPoints& surface, const SpinImageParams& params)
      : shape_(params.shape()),
        kernel_(spin_kernel()),
        support_(params),
        layout_(support_),
        surface_(surface, support_) {}

  const SpinImageShape& shape() const { return shape_; }
  std::size_t tiles() const { return surface_.tiles(); }

  void make(const OrientedPoints& spin_points, std::size_t first, std::span<float> images, std::size_t threads) const {
    const std::vector<std::size_t> order = spatial_order(spin_points, first, images.size() / shape_.size());
    const std::size_t at_once =
        std::clamp<std::size_t>(kSumsBytes / (layout_.size * sizeof(std::int64_t)), 1, kMostImages);
    Sums sums(std::min(at_once, order.size()) * layout_.size, 0);
    for (std::size_t begin = 0; begin < order.size(); begin += at_once) {
      const std::span group = std::span(order).subspan(begin, std::min(at_once, order.size() - begin));
      const auto image = [&](std::size_t g) {
        return images.subspan((group[g] - first) * shape_.size(), shape_.size());
      };
      if (threads > 1) {
        sum_sharing(spin_points, group, threads, sums);
      } else {
        sum_tiles(spin_points, group, 0, tiles(), sums.data());
      }
      for (std::size_t g = 0; g < group.size(); ++g) {
        kernel_.finish(support_, sums.data() + g * layout_.size, image(g));
      }
    }
  }

 private:
  // Spin points that are neighbours see the same part of the surface: one after the other they find it in the cache.
  std::vector<std::size_t> spatial_order(const OrientedPoints& spin_points, std::size_t first,
                                         std::size_t count) const {
    std::vector<std::uint32_t> keys(count);
    for (std::size_t k = 0; k < count; ++k) {
      const SpinPoint p = spin_point(spin_points, first + k);
      keys[k] = surface_.curve_key(p.x, p.y, p.z);
    }
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), first);
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return keys[k - first]; });
    return order;
  }

  // Adds what the tiles [begin, end) contribute to the images of `group`, to one set of sums an image.
  void sum_tiles(const OrientedPoints& spin_points, std::span<const std::size_t> group, std::size_t begin,
                 std::size_t end, std::int64_t* sums) const {
    std::vector<TileList> seen(group.size(), TileList(tiles()));
    for (std::size_t g = 0; g < group.size(); ++g) {
      TileList& list = seen[g];
      list.resize(kernel_.select_tiles(surface_, support_, spin_point(spin_points, group[g]), list.data()));
    }
    for (std::size_t from = begin; from < end; from += kTilesInCache) {
      const std::size_t to = std::min(from + kTilesInCache, end);
      for (std::size_t g = 0; g < group.size(); ++g) {
        const auto low = std::ranges::lower_bound(seen[g], from);
        const auto high = std::lower_bound(low, seen[g].end(), to);
        if (low != high) {
          kernel_.accumulate(surface_, support_, spin_point(spin_points, group[g]), {low, high},
                             sums + g * layout_.size);
        }
      }
    }
  }

  void sum_sharing(const OrientedPoints& spin_points, std::span<const std::size_t> group, std::size_t threads,
                   Sums& sums) const {
    const std::size_t slice = (tiles() + threads - 1) / threads;
    const auto make_slice = [&](std::size_t step, std::size_t) {
      Sums part(group.size() * layout_.size, 0);
      sum_tiles(spin_points, group, std::min(step * slice, tiles()), std::min((step + 1) * slice, tiles()),
                part.data());
      return part;
    };
    const auto add = [&](std::size_t, Sums& part) {
      std::transform(part.begin(), part.end(), sums.begin(), sums.begin(), std::plus<>());
    };
    InOrder<Sums>(threads, threads, make_slice, add);
  }

  SpinImageShape shape_;
  const SpinKernel& kernel_;
  Support support_;
  CellLayout layout_;
  SurfaceGroups surface_;
};

SpinImageMaker::SpinImageMaker(const OrientedPoints& surface, const SpinImageParams& params)
    : engine_(std::make_unique<const Engine>(surface, params)) {}

SpinImageMaker::~SpinImageMaker() = default;

const SpinImageShape& SpinImageMaker::shape() const {
  return engine_->shape();
}

void SpinImageMaker::make(const OrientedPoints& spin_points, std::size_t first, std::span<float> images,
                          std::size_t threads) const {
  engine_->make(spin_points, first, images, threads);
}

std::size_t SpinImageMaker::surface_pieces() const {
  return engine_->tiles();
}

}  // namespace spincat
