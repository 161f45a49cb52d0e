#include "spincat/encode/encoding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "spincat/error.h"

namespace spincat {

std::vector<double> Encoding::ObjectSums::sums_of_image(const SpinImageBlock& block, std::size_t k) const {
  SpinImageBlock alone{block.first + k, SpinImages(1, block.images.shape())};
  std::ranges::copy(block.images.image(k), alone.images.image(0).begin());
  std::vector<double> sums(size(), 0.0);
  accumulate(alone, sums);
  return sums;
}

FeatureVector Encoding::ObjectSums::finish_without(const SpinImageBlock& block, std::size_t k,
                                                   std::span<const double> sums) const {
  std::vector<double> rest = sums_of_image(block, k);
  std::ranges::transform(sums, rest, rest.begin(), std::minus<>());
  return finish(rest);
}

std::unique_ptr<Encoding> make_encoding(std::string_view name) {
  if (name == "pooled-pyramid") {
    return make_pooled_pyramid();
  }
  if (name == "concatenation") {
    return make_concatenation();
  }
  if (name == "mean-image") {
    return make_mean_image();
  }
  if (name == "bag-of-features") {
    return make_bag_of_features();
  }
  throw InputError(fmt::format("encoding '{}' is not known (one of {})", name, fmt::join(encoding_names(), ", ")));
}

const std::vector<std::string>& encoding_names() {
  static const std::vector<std::string> names = {"pooled-pyramid", "concatenation", "mean-image", "bag-of-features"};
  return names;
}

}  // namespace spincat
