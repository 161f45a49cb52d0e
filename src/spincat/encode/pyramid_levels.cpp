#include "spincat/encode/pyramid_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "spincat/geometry/mean_position.h"

namespace spincat {
namespace {

// The surface's normal at a spin point, whose image may have another axis. Spin points are the first points of a
// surface that was drawn.
Eigen::Vector3f normal_at(const OrientedPoints& surface, const OrientedPoints& spin_points, std::size_t k) {
  const bool is_of_surface = k < surface.size() && surface.position(k) == spin_points.position(k);
  return is_of_surface ? surface.normal(k) : spin_points.normal(k);
}

}  // namespace

std::vector<std::uint8_t> bands_of(const OrientedPoints& surface, const OrientedPoints& spin_points) {
  const Eigen::Vector3d g = mean_position(surface);
  const std::size_t count = spin_points.size();
  std::vector<double> r(count);
  std::vector<double> h(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d d = spin_points.position(k).cast<double>() - g;
    r[k] = d.norm();
    h[k] = std::abs(d.dot(normal_at(surface, spin_points, k).cast<double>()));
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

void Levels::reduce(const float* image) {
  const std::size_t half = width / 2;
  const std::size_t quarter = width / 4;
  copy_square(image, width, (width - quarter) / 2, cells[0]);
  sum_2x2(image, width, pairs_);
  copy_square(pairs_.data(), half, (half - quarter) / 2, cells[1]);
  sum_2x2(pairs_.data(), half, cells[2]);
}

// The W/4 x W/4 values of a picture of `columns` columns from row `first_row` and column 0 on.
void Levels::copy_square(const float* from, std::size_t columns, std::size_t first_row, std::vector<float>& to) const {
  const std::size_t edge = width / 4;
  for (std::size_t row = 0; row < edge; ++row) {
    std::copy_n(from + (first_row + row) * columns, edge, to.begin() + static_cast<std::ptrdiff_t>(row * edge));
  }
}

void Levels::sum_2x2(const float* from, std::size_t columns, std::vector<float>& to) {
  for (std::size_t row = 0; row < columns / 2; ++row) {
    const float* upper = from + 2 * row * columns;
    const float* lower = upper + columns;
    for (std::size_t column = 0; column < columns; ++column) {
      line_[column] = upper[column] + lower[column];
    }
    for (std::size_t column = 0; column < columns / 2; ++column) {
      to[row * (columns / 2) + column] = line_[2 * column] + line_[2 * column + 1];
    }
  }
}

}  // namespace spincat
