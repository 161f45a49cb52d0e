// The paper's: the rows of each image one after the other, the images one after the other, in the order of the spin
// points: M W W numbers, scaled to length 1 together; one block.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/encode/unit_length.h"

namespace spincat {
namespace {

class ConcatenatedSums final : public Encoding::ObjectSums {
 public:
  explicit ConcatenatedSums(std::size_t size) : size_(size) {}

  std::size_t size() const override { return size_; }

  void accumulate(const SpinImageBlock& block, std::span<double> sums) const override {
    std::ranges::copy(block.images.values(), sums.begin() + block.first * block.images.shape().size());
  }

  FeatureVector finish(std::span<const double> sums) const override {
    std::vector<double> values(sums.begin(), sums.end());
    scale_to_length(values, 1.0);
    return {{values.begin(), values.end()}, {static_cast<std::uint32_t>(values.size())}, "concatenation"};
  }

  bool add_contributions(const SpinImageBlock& block, std::span<const double> sums, std::span<const float> weights,
                         std::span<double> shares) const override {
    const std::size_t image = block.images.shape().size();
    const std::vector<float> values = finish(sums).values;
    for (std::size_t k = block.first; k < block.first + block.images.count(); ++k) {
      for (std::size_t i = k * image; i < (k + 1) * image; ++i) {
        shares[k] += static_cast<double>(weights[i]) * static_cast<double>(values[i]);
      }
    }
    return true;
  }

 private:
  std::size_t size_;
};

class Concatenation final : public Encoding {
 public:
  std::string_view name() const override { return "concatenation"; }

  bool pools() const override { return false; }

  void check(const SpinImageParams&) const override {}  // any image will do

  std::unique_ptr<ObjectSums> begin(const OrientedPoints&, const OrientedPoints& spin_points,
                                    const SpinImageParams& params) const override {
    return std::make_unique<ConcatenatedSums>(spin_points.size() * params.shape().size());
  }
};

}  // namespace

std::unique_ptr<Encoding> make_concatenation() {
  return std::make_unique<Concatenation>();
}

}  // namespace spincat
