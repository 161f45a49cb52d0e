#include "spincat/encode/encoding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "spincat/error.h"

namespace spincat {

#define ENCODING(name) std::unique_ptr<Encoding> make_##name();
#include "spincat/encode/encodings.inc"
#undef ENCODING

namespace {

constexpr std::array kMakers = {
#define ENCODING(name) make_##name,
#include "spincat/encode/encodings.inc"
#undef ENCODING
};

}  // namespace

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
  const auto found = std::ranges::find(encoding_names(), name);
  if (found == encoding_names().end()) {
    throw InputError(fmt::format("encoding '{}' is not known (one of {})", name, fmt::join(encoding_names(), ", ")));
  }
  return kMakers[static_cast<std::size_t>(found - encoding_names().begin())]();
}

const std::vector<std::string>& encoding_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& make : kMakers) {
      all.emplace_back(make()->name());
    }
    return all;
  }();
  return names;
}

}  // namespace spincat
