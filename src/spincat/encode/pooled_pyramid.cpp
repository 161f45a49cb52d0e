#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/encode/unit_length.h"
#include "spincat/error.h"

namespace spincat {
namespace {

constexpr std::size_t kLevels = 3;   // of the pyramid: single cells, sums of 2 x 2, sums of 4 x 4
constexpr std::size_t kBands = 4;    // into which the spin points are sorted
constexpr std::size_t kMoments = 2;  // mean and standard deviation

// Which of the four bands each spin point belongs to. With g the mean of the surface points, r = |p - g| and
// h = |(p - g) . n|: halves by r, then each half into halves by h. Both turn with the object, so that the same place on
// a turned object stays in the same band.
std::vector<std::uint8_t> bands_of(const OrientedPoints& surface, const OrientedPoints& spin_points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    sum += surface.position(i).cast<double>();
  }
  const Eigen::Vector3d g = sum / static_cast<double>(std::max<std::size_t>(surface.size(), 1));
  const std::size_t count = spin_points.size();
  std::vector<double> r(count);
  std::vector<double> h(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d d = spin_points.position(k).cast<double>() - g;
    r[k] = d.norm();
    h[k] = std::abs(d.dot(spin_points.normal(k).cast<double>()));
  }
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  const std::span<std::uint32_t> all(order);
  std::ranges::stable_sort(all, {}, [&](std::uint32_t k) { return r[k]; });
  std::vector<std::uint8_t> bands(count);
  std::uint8_t band = 0;
  for (const auto half : {all.first(count / 2), all.subspan(count / 2)}) {
    std::ranges::stable_sort(half, {}, [&](std::uint32_t k) { return h[k]; });
    for (const auto quarter : {half.first(half.size() / 2), half.subspan(half.size() / 2)}) {
      for (const std::uint32_t k : quarter) {
        bands[k] = band;
      }
      ++band;
    }
  }
  return bands;
}

// The pyramid of one channel of an image of W x W: three images of W/4 x W/4 cells around alpha = beta = 0, whose cells
// are single bins, sums of 2 x 2 and sums of 4 x 4.
struct Levels {
  explicit Levels(std::size_t image_width) : width(image_width), pairs(width / 2 * (width / 2)), line(width) {
    for (std::vector<float>& level : cells) {
      level.resize(width / 4 * (width / 4));
    }
  }

  void reduce(const float* image) {
    const std::size_t half = width / 2;
    const std::size_t quarter = width / 4;
    copy_square(image, width, (width - quarter) / 2, cells[0]);
    sum_2x2(image, width, pairs);
    copy_square(pairs.data(), half, (half - quarter) / 2, cells[1]);
    sum_2x2(pairs.data(), half, cells[2]);
  }

  std::size_t width;
  std::array<std::vector<float>, kLevels> cells;

 private:
  // The W/4 x W/4 values of a picture of `columns` columns from row `first_row` and column 0 on.
  void copy_square(const float* from, std::size_t columns, std::size_t first_row, std::vector<float>& to) const {
    const std::size_t edge = width / 4;
    for (std::size_t row = 0; row < edge; ++row) {
      std::copy_n(from + (first_row + row) * columns, edge, to.begin() + static_cast<std::ptrdiff_t>(row * edge));
    }
  }

  void sum_2x2(const float* from, std::size_t columns, std::vector<float>& to) {
    for (std::size_t row = 0; row < columns / 2; ++row) {
      const float* upper = from + 2 * row * columns;
      const float* lower = upper + columns;
      for (std::size_t column = 0; column < columns; ++column) {
        line[column] = upper[column] + lower[column];
      }
      for (std::size_t column = 0; column < columns / 2; ++column) {
        to[row * (columns / 2) + column] = line[2 * column] + line[2 * column + 1];
      }
    }
  }

  std::vector<float> pairs;  // sums of 2 x 2 over the whole image
  std::vector<float> line;
};

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

  FeatureVector finish(std::span<const double> sums) const override {
    std::vector<double> values(sums.size());
    const std::size_t bins = cells_ * cells_;
    for (std::size_t level = 0; level < kLevels; ++level) {
      for (std::size_t band = 0; band < kBands; ++band) {
        const double images = static_cast<double>(std::max<std::size_t>(images_in_band_[band], 1));
        for (std::size_t channel = 0; channel < shape_.channels; ++channel) {
          const std::size_t at = offset(level, band, channel);
          for (std::size_t bin = at; bin < at + bins; ++bin) {
            const double mean = sums[bin] / images;
            values[bin] = mean;
            values[bin + bins] = std::sqrt(std::max(0.0, sums[bin + bins] / images - mean * mean));
          }
        }
      }
      scale_to_length(std::span(values).subspan(level * level_size(), level_size()), 1.0 / std::sqrt(kLevels));
    }
    const std::vector<std::uint32_t> blocks(kLevels, static_cast<std::uint32_t>(level_size()));
    return {{values.begin(), values.end()}, blocks, "pooled-pyramid"};
  }

 private:
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
  std::array<std::size_t, kBands> images_in_band_{};
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
