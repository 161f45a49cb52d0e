// Gathering what belongs together: the legs and the top of a table do not touch in the picture, but they stand at one
// place.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "spincat/camera/segment/patches.h"

namespace spincat {
namespace {

constexpr float kLeastCell = 0.008F;  // metres
constexpr float kNoise = 0.5F;        // of a plane's tolerance at the things' depth: as wide is a cell at least
constexpr std::uint32_t kFewest = 2;  // pixels in a cell for it to count
constexpr int kMostCells = 4'000;     // along an axis; what lies beyond belongs to the last cell

// Where the pixels stand on the table, in cells.
class Footprint {
 public:
  Footprint(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table, const Labels& over_table)
      : x_axis_(table.normal.unitOrthogonal()), y_axis_(table.normal.cross(x_axis_)) {
    std::vector<Eigen::Vector2f> places;
    std::vector<float> depths;
    for (int v = 0; v < image.height; ++v) {
      for (int u = 0; u < image.width; ++u) {
        const std::size_t i = image.index(u, v);
        if (over_table[i] != 0) {
          const Eigen::Vector3f p = intrinsics.point(u, v, image.depth[i]);
          places.emplace_back(x_axis_.dot(p), y_axis_.dot(p));
          depths.push_back(p.z());
          pixels_.push_back(static_cast<std::uint32_t>(i));
        }
      }
    }
    count_pixels(places, cell_at(std::move(depths)));
  }

  // A label for each pixel: the component (8 neighbours) of the cells that count, where its own does.
  Labels components(std::size_t image_size) const {
    DisjointSets sets(counts_.size());
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const std::uint32_t cell = index(x, y);
        for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
          if (counts(x, y) && counts(x + dx, y + dy)) {
            sets.merge(cell, index(x + dx, y + dy));
          }
        }
      }
    }
    Labels labels(image_size, 0);
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      labels[pixels_[k]] = counts_[cells_[k]] >= kFewest ? sets.find(cells_[k]) + 1 : 0;
    }
    return labels;
  }

 private:
  // Readings of one surface are to fall into neighbouring cells.
  static float cell_at(std::vector<float> depths) {
    if (depths.empty()) {
      return kLeastCell;
    }
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::ranges::nth_element(depths, middle);
    return std::max(kLeastCell, kNoise * plane_tolerance(*middle));
  }

  void count_pixels(const std::vector<Eigen::Vector2f>& places, float cell) {
    Eigen::Vector2f low = Eigen::Vector2f::Zero();
    Eigen::Vector2f high = low;
    if (!places.empty()) {
      low = high = places.front();
    }
    for (const Eigen::Vector2f& p : places) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const auto cells = [&](float length) { return std::min(static_cast<int>(length / cell) + 1, kMostCells); };
    columns_ = cells(high.x() - low.x());
    rows_ = cells(high.y() - low.y());
    counts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (const Eigen::Vector2f& p : places) {
      const int x = std::min(static_cast<int>((p.x() - low.x()) / cell), columns_ - 1);
      const int y = std::min(static_cast<int>((p.y() - low.y()) / cell), rows_ - 1);
      cells_.push_back(index(x, y));
      ++counts_[cells_.back()];
    }
  }

  std::uint32_t index(int x, int y) const { return static_cast<std::uint32_t>(y * columns_ + x); }
  bool counts(int x, int y) const { return x >= 0 && x < columns_ && y < rows_ && counts_[index(x, y)] >= kFewest; }

  Eigen::Vector3f x_axis_;
  Eigen::Vector3f y_axis_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> pixels_;  // over the table
  std::vector<std::uint32_t> cells_;   // of each of them
  std::vector<std::uint32_t> counts_;  // pixels in each cell
};

}  // namespace

Labels gather_by_footprint(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                           const Labels& over_table) {
  return Footprint(image, intrinsics, table, over_table).components(over_table.size());
}

}  // namespace spincat
