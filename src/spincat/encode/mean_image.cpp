// The mean of all images, scaled to length 1: the simplest thing that forgets the order of the spin points. One block.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/encode/unit_length.h"

namespace spincat {
namespace {

class MeanImageSums final : public Encoding::ObjectSums {
 public:
  explicit MeanImageSums(std::size_t size) : size_(size) {}

  std::size_t size() const override { return size_; }

  void accumulate(const SpinImageBlock& block, std::span<double> sums) const override {
    for (std::size_t k = 0; k < block.images.count(); ++k) {
      std::ranges::transform(block.images.image(k), sums, sums.begin(),
                             [](float bin, double sum) { return sum + static_cast<double>(bin); });
    }
  }

  FeatureVector finish(std::span<const double> sums) const override {
    std::vector<double> values(sums.begin(), sums.end());
    scale_to_length(values, 1.0);  // a mean, then: the number of images cancels
    return {{values.begin(), values.end()}, {static_cast<std::uint32_t>(size_)}, "mean-image"};
  }

  // A feature is the sum of the images' bins over the length of all sums.
  bool add_contributions(const SpinImageBlock& block, std::span<const double> sums, std::span<const float> weights,
                         std::span<double> shares) const override {
    const double length = std::sqrt(std::inner_product(sums.begin(), sums.end(), sums.begin(), 0.0));
    for (std::size_t k = 0; k < block.images.count() && length > 0.0; ++k) {
      const std::span<const float> image = block.images.image(k);
      shares[block.first + k] += std::inner_product(image.begin(), image.end(), weights.begin(), 0.0) / length;
    }
    return true;
  }

 private:
  std::size_t size_;
};

class MeanImage final : public Encoding {
 public:
  std::string_view name() const override { return "mean-image"; }

  void check(const SpinImageParams&) const override {}  // any image will do

  std::unique_ptr<ObjectSums> begin(const OrientedPoints&, const OrientedPoints&,
                                    const SpinImageParams& params) const override {
    return std::make_unique<MeanImageSums>(params.shape().size());
  }
};

}  // namespace

std::unique_ptr<Encoding> make_mean_image() {
  return std::make_unique<MeanImage>();
}

}  // namespace spincat
