#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "spincat/camera/segment/hull.h"
#include "spincat/camera/segment/plane_rays.h"
#include "spincat/camera/segment/table.h"

namespace spincat {
namespace {

constexpr float kLeastCell = 0.02F;  // metres
constexpr float kMostCell = 0.1F;    // metres
constexpr float kRim = 0.12F;        // metres that the area is wider than what is seen
constexpr int kMostCells = 1'000;    // along an axis: 20 m
constexpr int kLeastNeighbours = 7;  // filled cells among a cell's 3 x 3 for it to count
constexpr int kStride = 2;           // every second pixel both ways is looked at
constexpr float kJustBelow = 0.2F;   // metres below the plane

std::size_t index_of(int x, int y, int columns) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
}

// A grid of cells that are filled (1) or not (0).
struct Grid {
  int columns;
  int rows;
  std::vector<std::uint8_t>& cells;

  std::size_t index(int x, int y) const { return index_of(x, y, columns); }

  std::uint8_t at(int x, int y) const { return x < 0 || y < 0 || x >= columns || y >= rows ? 0 : cells[index(x, y)]; }
};

// The cells with enough neighbours.
std::vector<GridPoint> dense_cells(const Grid& grid) {
  std::vector<GridPoint> kept;
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      int filled = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          filled += grid.at(x + dx, y + dy);
        }
      }
      if (filled >= kLeastNeighbours) {
        kept.push_back({x, y});
      }
    }
  }
  return kept;
}

// Those of the table's cells that hang together (8 neighbours) with most of the others, over cells where it may be.
std::vector<GridPoint> largest_component(const std::vector<GridPoint>& table, Grid may_be) {
  for (const GridPoint& c : table) {
    if (may_be.at(c.x, c.y) != 0) {
      may_be.cells[may_be.index(c.x, c.y)] = 2;
    }
  }
  std::vector<GridPoint> largest;
  for (const GridPoint& start : table) {
    if (may_be.at(start.x, start.y) != 2) {
      continue;
    }
    std::vector<GridPoint> reached;
    std::vector<GridPoint> component;
    const auto take = [&](int x, int y) {
      const std::uint8_t cell = may_be.at(x, y);
      if (cell == 0) {
        return;
      }
      if (cell == 2) {
        component.push_back({x, y});
      }
      may_be.cells[may_be.index(x, y)] = 0;
      reached.push_back({x, y});
    };
    take(start.x, start.y);
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const GridPoint p = reached[k];
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          take(p.x + dx, p.y + dy);
        }
      }
    }
    if (component.size() > largest.size()) {
      largest = std::move(component);
    }
  }
  return largest;
}

// The first and the last of each row: the others are no corners of the hull.
std::vector<GridPoint> outermost(const std::vector<GridPoint>& cells) {
  std::map<int, std::pair<int, int>> rows;
  for (const GridPoint& c : cells) {
    const auto [row, is_new] = rows.try_emplace(c.y, c.x, c.x);
    row->second = {std::min(row->second.first, c.x), std::max(row->second.second, c.x)};
  }
  std::vector<GridPoint> result;
  for (const auto& [y, ends] : rows) {
    result.push_back({ends.first, y});
    result.push_back({ends.second, y});
  }
  return result;
}

}  // namespace

// What the readings say of the plane.
class TableArea::Evidence {
 public:
  Evidence(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
           const Eigen::Vector3f& x_axis, const Eigen::Vector3f& y_axis)
      : image_(image),
        focal_(intrinsics.fx),
        offset_(table.offset),
        rays_(image.width, image.height, intrinsics, table, x_axis, y_axis) {}

  // Where a reading lies along the plane.
  Eigen::Vector2f place(int u, int v) const { return image_.at(u, v) * rays_.at(u, v).head<2>().matrix(); }

  // Whether the reading is one of the table: on the plane, and its surface goes on along it to one side, in rows and in
  // columns. A wall that passes through the plane goes on along one of them alone.
  bool is_of_table(int u, int v) const {
    if (!lies_on(u, v)) {
      return false;
    }
    // So far that on a wall the plane would be left.
    const float z = image_.at(u, v);
    const int step = pixels_of(2.0F * plane_tolerance(z), z, focal_, kStride);
    return (lies_on(u - step, v) || lies_on(u + step, v)) && (lies_on(u, v - step) || lies_on(u, v + step));
  }

  // Where a pixel's ray meets the plane, if it does.
  std::optional<Eigen::Vector2f> crossing(int u, int v) const {
    constexpr float kGrazing = 0.02F;
    const Eigen::Array3f ray = rays_.at(u, v);
    return ray[2] > -kGrazing ? std::nullopt : std::optional<Eigen::Vector2f>(-offset_ / ray[2] * ray.head<2>());
  }

  // Whether the reading lies below the plane: the ray met no table on its way.
  bool is_below(int u, int v) const {
    const float z = image_.at(u, v);
    return z > 0.0F && rays_.height(u, v, z) < -plane_tolerance(z);
  }

  // Whether a reading below the plane is of something that comes up from there, as a wall does, but not of the floor.
  bool is_just_below(int u, int v) const { return rays_.height(u, v, image_.at(u, v)) > -kJustBelow; }

 private:
  bool lies_on(int u, int v) const {
    if (u < 0 || v < 0 || u >= image_.width || v >= image_.height) {
      return false;
    }
    const float z = image_.at(u, v);
    return z > 0.0F && std::abs(rays_.height(u, v, z)) < plane_tolerance(z);
  }

  const DepthImage& image_;
  double focal_;
  float offset_;
  PlaneRays rays_;
};

TableArea::TableArea(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table)
    : x_axis_(table.normal.unitOrthogonal()), y_axis_(table.normal.cross(x_axis_)) {
  const Evidence evidence(image, intrinsics, table, x_axis_, y_axis_);
  std::vector<std::uint8_t> filled = filled_cells(image, intrinsics, table.offset, evidence);
  std::vector<std::uint8_t> possible = possible_cells(image, evidence);
  const std::vector<GridPoint> seen =
      largest_component(dense_cells({columns_, rows_, filled}), {columns_, rows_, possible});
  if (seen.empty()) {
    return;
  }
  const std::vector<GridPoint> hull = convex_hull(outermost(seen));
  std::vector<GridPoint> grown;
  const int rim = rim_cells();
  for (const GridPoint& c : hull) {
    outline_.push_back(point_of(c.x, c.y, table));
    for (const auto& [dx, dy] : {std::array{-rim, -rim}, {-rim, rim}, {rim, -rim}, {rim, rim}}) {
      grown.push_back({c.x + dx, c.y + dy});
    }
  }
  cells_.assign(filled.size(), Place::outside);
  mark(convex_hull(std::move(grown)), Place::rim);
  mark(hull, Place::inside);
}

// Convex: in each row the cells from the first to the last.
void TableArea::mark(const std::vector<GridPoint>& hull, Place place) {
  for (int y = 0; y < rows_; ++y) {
    int first = 0;
    while (first < columns_ && !is_inside(hull, {first, y})) {
      ++first;
    }
    int last = columns_ - 1;
    while (last > first && !is_inside(hull, {last, y})) {
      --last;
    }
    for (int x = first; x <= last; ++x) {
      cells_[index_of(x, y, columns_)] = place;
    }
  }
}

// The middle of a cell, on the plane.
Eigen::Vector3f TableArea::point_of(int x, int y, const SupportPlane& table) const {
  return (low_.x() + (static_cast<float>(x) + 0.5F) * cell_) * x_axis_ +
         (low_.y() + (static_cast<float>(y) + 0.5F) * cell_) * y_axis_ - table.offset * table.normal;
}

int TableArea::rim_cells() const {
  return static_cast<int>(std::lround(kRim / cell_));
}

// Chooses the grid around the readings of the table, and fills the cells that hold one.
std::vector<std::uint8_t> TableArea::filled_cells(const DepthImage& image, const Intrinsics& intrinsics,
                                                  float camera_height, const Evidence& evidence) {
  std::vector<Eigen::Vector2f> on_table;
  std::vector<float> depths;
  for (int v = 0; v < image.height; v += kStride) {
    for (int u = 0; u < image.width; u += kStride) {
      if (evidence.is_of_table(u, v)) {
        on_table.push_back(evidence.place(u, v));
        depths.push_back(image.at(u, v));
      }
    }
  }
  if (on_table.empty()) {
    return {};
  }
  // As wide as rows of readings are apart where the plane is far, so that no cell there is empty.
  const auto far = depths.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(depths.size()));
  std::ranges::nth_element(depths, far);
  const float row = *far * *far / (static_cast<float>(intrinsics.fy) * std::max(camera_height, 0.01F));
  cell_ = std::clamp(1.2F * static_cast<float>(kStride) * row, kLeastCell, kMostCell);
  Eigen::Vector2f low = on_table.front();
  Eigen::Vector2f high = low;
  for (const Eigen::Vector2f& p : on_table) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const int margin = rim_cells() + 1;
  low_ = low.array() - static_cast<float>(margin) * cell_;
  columns_ = std::min(static_cast<int>((high.x() - low.x()) / cell_) + 2 * margin + 1, kMostCells);
  rows_ = std::min(static_cast<int>((high.y() - low.y()) / cell_) + 2 * margin + 1, kMostCells);
  std::vector<std::uint8_t> filled(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  for (const Eigen::Vector2f& p : on_table) {
    const int x = static_cast<int>((p.x() - low_.x()) / cell_);
    const int y = static_cast<int>((p.y() - low_.y()) / cell_);
    if (x < columns_ && y < rows_) {
      filled[index_of(x, y, columns_)] = 1;
    }
  }
  return filled;
}

// The cells where more rays say that the table may be there than say that it is not: it may be hidden.
std::vector<std::uint8_t> TableArea::possible_cells(const DepthImage& image, const Evidence& evidence) const {
  std::vector<int> votes(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  const auto vote = [&](const Eigen::Vector2f& place, int weight) {
    const Cell cell = cell_of(place);
    if (cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_) {
      votes[index_of(cell.x, cell.y, columns_)] += weight;
    }
  };
  for (int v = 0; v < image.height; v += kStride) {
    for (int u = 0; u < image.width; u += kStride) {
      const bool is_below = evidence.is_below(u, v);
      if (const auto crossing = evidence.crossing(u, v)) {
        vote(*crossing, is_below ? -1 : 1);
      }
      if (is_below && evidence.is_just_below(u, v)) {
        vote(evidence.place(u, v), -1);
      }
    }
  }
  std::vector<std::uint8_t> possible(votes.size());
  std::ranges::transform(votes, possible.begin(), [](int sum) -> std::uint8_t { return sum > 0 ? 1 : 0; });
  return possible;
}

TableArea::Cell TableArea::cell_of(const Eigen::Vector2f& place) const {
  return {static_cast<int>(std::floor((place.x() - low_.x()) / cell_)),
          static_cast<int>(std::floor((place.y() - low_.y()) / cell_))};
}

TableArea::Place TableArea::place_of(const Eigen::Vector3f& point) const {
  return place_at({x_axis_.dot(point), y_axis_.dot(point)});
}

TableArea::Place TableArea::place_at(const Eigen::Vector2f& place) const {
  if (cells_.empty()) {
    return Place::outside;
  }
  const Cell cell = cell_of(place);
  const bool is_in_grid = cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_;
  return is_in_grid ? cells_[index_of(cell.x, cell.y, columns_)] : Place::outside;
}

}  // namespace spincat
