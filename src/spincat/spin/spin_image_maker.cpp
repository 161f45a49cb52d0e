#include "spincat/spin/spin_image_maker.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
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

// Images under way at a time: kTilesAtOnce tiles of the surface stay in the second-level cache for all of them, and so
// do their sums.
constexpr std::size_t kMostImages = 16;
constexpr std::size_t kSumsBytes = 384 * 1024;

SpinPoint spin_point(const OrientedPoints& points, std::size_t k) {
  return {points.x()[k], points.y()[k], points.z()[k], points.nx()[k], points.ny()[k], points.nz()[k]};
}

}  // namespace

class SpinImageMaker::Engine {
 public:
  Engine(const OrientedPoints& surface, const SpinImageParams& params, int threads)
      : shape_(params.shape()),
        kernel_(spin_kernel()),
        support_(params),
        layout_(support_),
        surface_(surface, support_, threads) {}

  const SpinImageShape& shape() const { return shape_; }
  std::size_t tiles() const { return surface_.tiles(); }

  // One image that is wanted: of which spin point, and where to.
  struct Wanted {
    SpinPoint p;
    std::span<float> image;
  };

  void make(std::vector<Wanted> wanted, std::size_t workers) const {
    sort_in_space(wanted);
    constexpr std::size_t kFewImages = 4;  // a thread's, below which the threads share out the surface
    if (workers > 1 && wanted.size() < kFewImages * workers) {
      make_sharing_surface(wanted, workers);
    } else {
      make_sharing_images(wanted, workers);
    }
  }

 private:
  // Spin points that are neighbours see the same part of the surface: one after the other they find it in the cache.
  void sort_in_space(std::vector<Wanted>& wanted) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(wanted.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) {
      const SpinPoint& p = wanted[k].p;
      order[k] = {surface_.curve_key(p.x, p.y, p.z), k};
    }
    std::ranges::sort(order);
    std::vector<Wanted> sorted;
    sorted.reserve(wanted.size());
    for (const auto& [key, k] : order) {
      sorted.push_back(wanted[k]);
    }
    wanted.swap(sorted);
  }

  // How many images are under way at a time.
  std::size_t images_at_once() const {
    return std::clamp<std::size_t>(kSumsBytes / (layout_.size * sizeof(std::int64_t)), 1, kMostImages);
  }

  // Several runs a thread: where the surface is dense, images take longer than elsewhere.
  void make_sharing_images(std::span<const Wanted> wanted, std::size_t workers) const {
    constexpr std::size_t kRunsOfThread = 2;
    const std::size_t runs = workers == 1 ? 1 : workers * kRunsOfThread;
    std::vector<Sums> sums(workers);  // of the images that a thread has under way; zero between runs
    for_each_step(runs, workers, [&](std::size_t run, std::size_t worker) {
      const std::size_t begin = run * wanted.size() / runs;
      const std::size_t end = (run + 1) * wanted.size() / runs;
      make_run(wanted.subspan(begin, end - begin), sums[worker]);
    });
  }

  void make_run(std::span<const Wanted> wanted, Sums& sums) const {
    sums.resize(std::max(sums.size(), std::min(images_at_once(), wanted.size()) * layout_.size), 0);
    while (!wanted.empty()) {
      const auto group = wanted.first(std::min(images_at_once(), wanted.size()));
      sum_tiles(group, 0, tiles(), sums.data());
      finish(group, sums);
      wanted = wanted.subspan(group.size());
    }
  }

  void make_sharing_surface(std::span<const Wanted> wanted, std::size_t workers) const {
    while (!wanted.empty()) {
      const auto group = wanted.first(std::min(images_at_once(), wanted.size()));
      const std::size_t slice = (tiles() + workers - 1) / workers;
      Sums sums(group.size() * layout_.size, 0);
      const auto make_slice = [&](std::size_t step, std::size_t) {
        Sums part(sums.size(), 0);
        sum_tiles(group, std::min(step * slice, tiles()), std::min((step + 1) * slice, tiles()), part.data());
        return part;
      };
      const auto add = [&](std::size_t, Sums& part) {
        std::transform(part.begin(), part.end(), sums.begin(), sums.begin(), std::plus<>());
      };
      InOrder<Sums>(workers, workers, make_slice, add);  // NOLINT(bugprone-unused-raii): making it does the work
      finish(group, sums);
      wanted = wanted.subspan(group.size());
    }
  }

  void finish(std::span<const Wanted> group, Sums& sums) const {
    for (std::size_t g = 0; g < group.size(); ++g) {
      kernel_.finish(support_, sums.data() + g * layout_.size, group[g].image);
    }
  }

  // The surface passes through the cache in portions of about kTilesAtOnce tiles, each used for all images of a group:
  // every portions()-th tile, so that its points fall into many different cells of an image.
  std::size_t portions() const { return std::max<std::size_t>(tiles() / kTilesAtOnce, 1); }

  // The tiles of [begin, end) that may lie in the support of `p`: rising if they are few, else portion by portion.
  TileList seen_tiles(const SpinPoint& p, std::size_t begin, std::size_t end) const {
    TileList list(tiles());
    list.resize(kernel_.select_tiles(surface_, support_, p, list.data()));
    std::erase_if(list, [&](std::uint32_t tile) { return tile < begin || tile >= end; });
    return list.size() > kTilesAtOnce ? by_portion(list) : list;
  }

  TileList by_portion(const TileList& list) const {
    std::vector<char> listed(tiles(), 0);
    for (const std::uint32_t tile : list) {
      listed[tile] = 1;
    }
    TileList sorted;
    sorted.reserve(list.size());
    for (std::size_t portion = 0; portion < portions(); ++portion) {
      for (std::size_t tile = portion; tile < tiles(); tile += portions()) {
        if (listed[tile] != 0) {
          sorted.push_back(static_cast<std::uint32_t>(tile));
        }
      }
    }
    return sorted;
  }

  // Adds what the tiles [begin, end) contribute to the images of `group`, to one set of sums an image.
  void sum_tiles(std::span<const Wanted> group, std::size_t begin, std::size_t end, std::int64_t* sums) const {
    std::vector<TileList> many(group.size());  // those of images that see much of the surface
    bool any = false;
    for (std::size_t g = 0; g < group.size(); ++g) {
      many[g] = seen_tiles(group[g].p, begin, end);
      if (many[g].size() <= kTilesAtOnce) {
        sum_portion(group[g].p, many[g], sums + g * layout_.size);
        many[g].clear();
      }
      any = any || !many[g].empty();
    }
    std::vector<std::size_t> done(group.size(), 0);
    for (std::size_t portion = 0; any && portion < portions(); ++portion) {
      for (std::size_t g = 0; g < group.size(); ++g) {
        const std::span rest = std::span(many[g]).subspan(done[g]);
        const auto last = std::ranges::find_if(rest, [&](auto tile) { return tile % portions() != portion; });
        sum_portion(group[g].p, {rest.begin(), last}, sums + g * layout_.size);
        done[g] += static_cast<std::size_t>(last - rest.begin());
      }
    }
  }

  void sum_portion(const SpinPoint& p, std::span<const std::uint32_t> tiles_of_it, std::int64_t* sums) const {
    while (!tiles_of_it.empty()) {
      const auto now = tiles_of_it.first(std::min(tiles_of_it.size(), kTilesAtOnce));
      kernel_.accumulate(surface_, support_, p, now, sums);
      tiles_of_it = tiles_of_it.subspan(now.size());
    }
  }

  SpinImageShape shape_;
  const SpinKernel& kernel_;
  Support support_;
  CellLayout layout_;
  SurfaceGroups surface_;
};

SpinImageMaker::SpinImageMaker(const OrientedPoints& surface, const SpinImageParams& params, int threads)
    : engine_(std::make_unique<const Engine>(surface, params, threads)) {}

SpinImageMaker::~SpinImageMaker() = default;

const SpinImageShape& SpinImageMaker::shape() const {
  return engine_->shape();
}

void SpinImageMaker::make(const OrientedPoints& spin_points, std::size_t first, std::span<float> images,
                          int threads) const {
  std::vector<Engine::Wanted> wanted;
  for (std::size_t k = 0; k < images.size() / shape().size(); ++k) {
    wanted.push_back({spin_point(spin_points, first + k), images.subspan(k * shape().size(), shape().size())});
  }
  engine_->make(std::move(wanted), static_cast<std::size_t>(std::max(threads, 1)));
}

void SpinImageMaker::make(const OrientedPoints& spin_points, std::span<SpinImageBlock> blocks, int threads) const {
  std::vector<Engine::Wanted> wanted;
  for (SpinImageBlock& block : blocks) {
    for (std::size_t k = 0; k < block.images.count(); ++k) {
      wanted.push_back({spin_point(spin_points, block.first + k), block.images.image(k)});
    }
  }
  engine_->make(std::move(wanted), static_cast<std::size_t>(std::max(threads, 1)));
}

}  // namespace spincat
