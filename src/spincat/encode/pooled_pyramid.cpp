// Our default: each image is reduced to a pyramid of three smaller ones (the inner quarter at full resolution, the
// inner half and the whole, coarser), square roots are taken, and the mean and the standard deviation of every bin over
// the spin points of each of four bands is one feature, each image a block; docs/how-it-works/encoding.md. Needs an
// image width divisible by 8 in the johnson convention.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/encode/pyramid_levels.h"
#include "spincat/encode/unit_length.h"
#include "spincat/error.h"

namespace spincat {
namespace {

constexpr std::size_t kMoments = 2;  // mean and standard deviation
using BandCounts = std::array<std::size_t, kBands>;

// Sums, for each level, band, channel and cell, of the square root of the cell and of the square of that root: from
// these the mean and the deviation.
class PyramidSums final : public Encoding::ObjectSums {
 public:
  PyramidSums(const OrientedPoints& surface, const OrientedPoints& spin_points, const SpinImageParams& params)
      : shape_(params.shape()),
        cells_(shape_.columns / 4),
        points_(static_cast<double>(std::max<std::size_t>(surface.size(), 1))),
        bands_(bands_of(surface, spin_points)) {
    for (const std::uint8_t band : bands_) {
      ++images_in_band_[band];
    }
  }

  std::size_t size() const override { return kLevels * level_size(); }

  void accumulate(const SpinImageBlock& block, std::span<double> sums) const override {
    Levels levels(shape_.columns);
    for (std::size_t k = 0; k < block.images.count(); ++k) {
      const std::uint8_t band = bands_[block.first + k];
      for (std::size_t channel = 0; channel < shape_.channels; ++channel) {
        levels.reduce(block.images.image(k).data() + channel * shape_.rows * shape_.columns);
        for (std::size_t level = 0; level < kLevels; ++level) {
          add_cells(levels.cells[level], sums.subspan(offset(level, band, channel), 2 * cells_ * cells_));
        }
      }
    }
  }

  FeatureVector finish(std::span<const double> sums) const override { return finish_bands(sums, images_in_band_); }

  // A mean is the sum of the images' roots r / n, and a deviation s = s^2 / s the sum of their (r - mean)^2 / (n s).
  bool add_contributions(const SpinImageBlock& block, std::span<const double> sums, std::span<const float> weights,
                         std::span<double> shares) const override {
    const std::vector<Gives> gives = gives_of(sums, weights);
    Levels levels(shape_.columns);
    for (std::size_t k = 0; k < block.images.count(); ++k) {
      const std::uint8_t band = bands_[block.first + k];
      for (std::size_t channel = 0; channel < shape_.channels; ++channel) {
        levels.reduce(block.images.image(k).data() + channel * shape_.rows * shape_.columns);
        for (std::size_t level = 0; level < kLevels; ++level) {
          shares[block.first + k] +=
              share_of(levels.cells[level], std::span(gives).subspan(offset(level, band, channel) / kMoments));
        }
      }
    }
    return true;
  }

  FeatureVector finish_without(const SpinImageBlock& block, std::size_t k,
                               std::span<const double> sums) const override {
    std::vector<double> rest = sums_of_image(block, k);
    std::ranges::transform(sums, rest, rest.begin(), std::minus<>());
    const std::uint8_t band = bands_[block.first + k];
    BandCounts images = images_in_band_;
    if (--images[band] == 0) {  // what is left of its sums is rounding
      for (std::size_t level = 0; level < kLevels; ++level) {
        const std::size_t length = level_size() / kBands;
        std::fill_n(rest.begin() + static_cast<std::ptrdiff_t>(offset(level, band, 0)), length, 0.0);
      }
    }
    return finish_bands(rest, images);
  }

 private:
  // What a root r in one bin gives: by_root * r + by_square * (r - mean)^2.
  struct Gives {
    double mean = 0.0;
    double by_root = 0.0;
    double by_square = 0.0;
  };

  FeatureVector finish_bands(std::span<const double> sums, const BandCounts& images) const {
    std::vector<double> values(sums.size());
    for (std::size_t level = 0; level < kLevels; ++level) {
      fill_level(sums, level, images, values);
      scale_to_length(std::span(values).subspan(level * level_size(), level_size()), 1.0 / std::sqrt(kLevels));
    }
    const std::vector<std::uint32_t> blocks(kLevels, static_cast<std::uint32_t>(level_size()));
    return {{values.begin(), values.end()}, blocks, "pooled-pyramid"};
  }

  // One for each mean, in their order.
  std::vector<Gives> gives_of(std::span<const double> sums, std::span<const float> weights) const {
    const std::size_t bins = cells_ * cells_;
    std::vector<Gives> gives(sums.size() / kMoments);
    std::vector<double> values(sums.size());
    for (std::size_t level = 0; level < kLevels; ++level) {
      fill_level(sums, level, images_in_band_, values);
      const auto part = std::span<const double>(values).subspan(level * level_size(), level_size());
      const double length = std::sqrt(std::inner_product(part.begin(), part.end(), part.begin(), 0.0));
      const double scale = length > 0.0 ? 1.0 / (length * std::sqrt(kLevels)) : 0.0;
      for (std::size_t at = level * level_size(); at < (level + 1) * level_size(); at += kMoments * bins) {
        const double images = pooled_over(at, images_in_band_);
        for (std::size_t bin = at; bin < at + bins; ++bin) {
          const double spread = images * values[bin + bins];
          gives[at / kMoments + bin - at] = {
              values[bin], scale * static_cast<double>(weights[bin]) / images,
              spread > 0.0 ? scale * static_cast<double>(weights[bin + bins]) / spread : 0.0};
        }
      }
    }
    return gives;
  }

  double share_of(const std::vector<float>& cells, std::span<const Gives> gives) const {
    const auto scale = static_cast<float>(1.0 / points_);
    double share = 0.0;
    for (std::size_t bin = 0; bin < cells.size(); ++bin) {
      const auto root = static_cast<double>(std::sqrt(cells[bin] * scale));
      const double from_mean = root - gives[bin].mean;
      share += gives[bin].by_root * root + gives[bin].by_square * from_mean * from_mean;
    }
    return share;
  }

  // How many images the bins at this offset are pooled over, at least 1.
  double pooled_over(std::size_t at, const BandCounts& images) const {
    const std::size_t band = at % level_size() / (level_size() / kBands);
    return static_cast<double>(std::max<std::size_t>(images[band], 1));
  }

  // Means and deviations of one level, not yet scaled.
  void fill_level(std::span<const double> sums, std::size_t level, const BandCounts& images,
                  std::span<double> values) const {
    const std::size_t bins = cells_ * cells_;
    for (std::size_t at = level * level_size(); at < (level + 1) * level_size(); at += kMoments * bins) {
      const double count = pooled_over(at, images);
      for (std::size_t bin = at; bin < at + bins; ++bin) {
        const double mean = sums[bin] / count;
        values[bin] = mean;
        values[bin + bins] = std::sqrt(std::max(0.0, sums[bin + bins] / count - mean * mean));
      }
    }
  }

  std::size_t level_size() const { return kBands * shape_.channels * kMoments * cells_ * cells_; }

  std::size_t offset(std::size_t level, std::size_t band, std::size_t channel) const {
    return level * level_size() + (band * shape_.channels + channel) * kMoments * cells_ * cells_;
  }

  // Square roots in single precision are exact enough (the images are floats too) and four times as fast. Their squares
  // are taken again in double, not from the cell itself: otherwise equal images would have a deviation by rounding.
  void add_cells(const std::vector<float>& cells, std::span<double> sums) const {
    const auto scale = static_cast<float>(1.0 / points_);
    double* roots = sums.data();
    double* squares = roots + cells.size();
    for (std::size_t bin = 0; bin < cells.size(); ++bin) {
      const auto root = static_cast<double>(std::sqrt(cells[bin] * scale));
      roots[bin] += root;
      squares[bin] += root * root;
    }
  }

  SpinImageShape shape_;
  std::size_t cells_;  // rows and columns of each level
  double points_;      // surface points: a bin becomes its share of them
  std::vector<std::uint8_t> bands_;
  BandCounts images_in_band_{};
};

class PooledPyramid final : public Encoding {
 public:
  std::string_view name() const override { return "pooled-pyramid"; }

  void check(const SpinImageParams& params) const override {
    if (params.convention != SpinConvention::johnson || params.image_width % 8 != 0) {
      throw InputError(
          fmt::format("the pooled-pyramid encoding needs the johnson convention and an image width "
                      "divisible by 8, not {}",
                      params.image_width));
    }
  }

  std::unique_ptr<ObjectSums> begin(const OrientedPoints& surface, const OrientedPoints& spin_points,
                                    const SpinImageParams& params) const override {
    return std::make_unique<PyramidSums>(surface, spin_points, params);
  }
};

}  // namespace

std::unique_ptr<Encoding> make_pooled_pyramid() {
  return std::make_unique<PooledPyramid>();
}

}  // namespace spincat
