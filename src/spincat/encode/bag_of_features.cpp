// The images of kLocalFeatures spin points one by one, each reduced to at most 10 x 10 cells a channel, as square roots
// of shares of the surface points: local features, to be counted by a codebook that was learned from training objects
// (codebook.h) before judges see them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "spincat/encode/codebook.h"
#include "spincat/encode/encoding.h"

namespace spincat {
namespace {

constexpr std::size_t kMostCells = 10;  // rows and columns of a local feature

// The local features of the first kLocalFeatures images, one after the other. Where an object has fewer images they are
// repeated, which changes the shares of the words by little.
class BagSums final : public Encoding::ObjectSums {
 public:
  BagSums(std::size_t surface_points, std::size_t images, SpinImageShape shape)
      : scale_(1.0 / static_cast<double>(std::max<std::size_t>(surface_points, 1))),
        images_(std::min(std::max<std::size_t>(images, 1), kLocalFeatures)),
        shape_(shape),
        rows_(std::min(shape.rows, kMostCells)),
        columns_(std::min(shape.columns, kMostCells)) {}

  std::size_t size() const override { return images_ * local_size(); }

  void accumulate(const SpinImageBlock& block, std::span<double> sums) const override {
    for (std::size_t k = 0; k < block.images.count() && block.first + k < images_; ++k) {
      add_cells(block.images.image(k), sums.subspan((block.first + k) * local_size(), local_size()));
    }
  }

  FeatureVector finish(std::span<const double> sums) const override {
    FeatureVector features{{}, {}, "bag-of-features", static_cast<std::uint32_t>(local_size())};
    features.values.reserve(kLocalFeatures * local_size());
    const std::size_t images = sums.size() / local_size();
    for (std::size_t i = 0; i < kLocalFeatures; ++i) {
      for (const double cell : sums.subspan(i % images * local_size(), local_size())) {
        features.values.push_back(static_cast<float>(std::sqrt(cell * scale_)));
      }
    }
    features.blocks = {static_cast<std::uint32_t>(features.values.size())};
    return features;
  }

  // As an object with one image fewer, whose place others take. The only image stays.
  FeatureVector finish_without(const SpinImageBlock& block, std::size_t k,
                               std::span<const double> sums) const override {
    std::vector<double> rest(sums.begin(), sums.end());
    if (block.first + k < images_ && images_ > 1) {
      const auto begin = rest.begin() + static_cast<std::ptrdiff_t>((block.first + k) * local_size());
      rest.erase(begin, begin + static_cast<std::ptrdiff_t>(local_size()));
    }
    return finish(rest);
  }

 private:
  std::size_t local_size() const { return shape_.channels * rows_ * columns_; }

  // Adds the bins of an image up into cells of about the same size.
  void add_cells(std::span<const float> image, std::span<double> cells) const {
    std::size_t bin = 0;
    for (std::size_t channel = 0; channel < shape_.channels; ++channel) {
      for (std::size_t row = 0; row < shape_.rows; ++row) {
        const std::size_t line = (channel * rows_ + row * rows_ / shape_.rows) * columns_;
        for (std::size_t column = 0; column < shape_.columns; ++column) {
          cells[line + column * columns_ / shape_.columns] += static_cast<double>(image[bin++]);
        }
      }
    }
  }

  double scale_;
  std::size_t images_;
  SpinImageShape shape_;
  std::size_t rows_;
  std::size_t columns_;
};

class BagOfFeatures final : public Encoding {
 public:
  std::string_view name() const override { return "bag-of-features"; }

  bool gives_local_features() const override { return true; }

  void check(const SpinImageParams&) const override {}  // any image will do

  std::unique_ptr<ObjectSums> begin(const OrientedPoints& surface, const OrientedPoints& spin_points,
                                    const SpinImageParams& params) const override {
    return std::make_unique<BagSums>(surface.size(), spin_points.size(), params.shape());
  }
};

}  // namespace

std::unique_ptr<Encoding> make_bag_of_features() {
  return std::make_unique<BagOfFeatures>();
}

}  // namespace spincat
