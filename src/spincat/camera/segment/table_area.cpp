#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "spincat/camera/segment/hull.h"
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

}  // namespace

// What the readings say of the plane.
class TableArea::Evidence {
 public:
  Evidence(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table)
      : image_(image), intrinsics_(intrinsics), table_(table) {}

  // Whether the reading is one of the table: on the plane, and its surface goes on along it to one side, in rows and in
  // columns. A wall that passes through the plane goes on along one of them alone.
  bool is_of_table(int u, int v) const {
    const float z = image_.at(u, v);
    if (!lies_on(u, v)) {
      return false;
    }
    // So far that on a wall the plane would be left.
    const int step = std::max(static_cast<int>(std::lround(2.0F * plane_tolerance(z) * intrinsics_.fx / z)), kStride);
    return (lies_on(u - step, v) || lies_on(u + step, v)) && (lies_on(u, v - step) || lies_on(u, v + step));
  }

  // Where a pixel's ray meets the plane, and whether the table may be there: not where it goes on far beyond.
  struct Crossing {
    Eigen::Vector3f point;
    bool may_be_table;
  };
  std::optional<Crossing> crossing(int u, int v) const {
    const Eigen::Vector3f ray = intrinsics_.point(u, v, 1.0F);
    const float towards = -table_.normal.dot(ray);
    if (towards < kGrazing) {
      return {};
    }
    const float z = image_.at(u, v);
    const Eigen::Vector3f point = table_.offset / towards * ray;
    return Crossing{point, !(z > 0.0F && table_.height(z * ray) < -plane_tolerance(z))};
  }

  // Whether the reading is of something that comes up from below, as a wall does, but not of the floor.
  bool is_just_below(int u, int v) const {
    const float z = image_.at(u, v);
    const float height = table_.height(intrinsics_.point(u, v, z));
    return z > 0.0F && height < -plane_tolerance(z) && height > -kJustBelow;
  }

 private:
  static constexpr float kGrazing = 0.02F;

  bool lies_on(int u, int v) const {
    if (u < 0 || v < 0 || u >= image_.width || v >= image_.height) {
      return false;
    }
    const float z = image_.at(u, v);
    return z > 0.0F && std::abs(table_.height(intrinsics_.point(u, v, z))) < plane_tolerance(z);
  }

  const DepthImage& image_;
  const Intrinsics& intrinsics_;
  const SupportPlane& table_;
};

TableArea::TableArea(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table)
    : x_axis_(table.normal.unitOrthogonal()), y_axis_(table.normal.cross(x_axis_)) {
  const Evidence evidence(image, intrinsics, table);
  std::vector<std::uint8_t> filled = filled_cells(image, intrinsics, table.offset, evidence);
  std::vector<std::uint8_t> possible = possible_cells(image, intrinsics, evidence);
  const std::vector<GridPoint> seen =
      largest_component(dense_cells({columns_, rows_, filled}), {columns_, rows_, possible});
  if (seen.empty()) {
    return;
  }
  std::vector<GridPoint> grown;
  const int rim = rim_cells();
  for (const GridPoint& c : seen) {
    for (const auto& [dx, dy] : {std::array{-rim, -rim}, {-rim, rim}, {rim, -rim}, {rim, rim}}) {
      grown.push_back({c.x + dx, c.y + dy});
    }
  }
  const std::vector<GridPoint> hull = convex_hull(seen);
  const std::vector<GridPoint> wider = convex_hull(std::move(grown));
  for (const GridPoint& corner : hull) {
    outline_.push_back(point_of(corner.x, corner.y, table));
  }
  cells_.assign(filled.size(), Place::outside);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      cells_[index_of(x, y, columns_)] = is_inside(hull, {x, y})    ? Place::inside
                                         : is_inside(wider, {x, y}) ? Place::rim
                                                                    : Place::outside;
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
        const Eigen::Vector3f p = intrinsics.point(u, v, image.at(u, v));
        on_table.emplace_back(x_axis_.dot(p), y_axis_.dot(p));
        depths.push_back(p.z());
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
std::vector<std::uint8_t> TableArea::possible_cells(const DepthImage& image, const Intrinsics& intrinsics,
                                                    const Evidence& evidence) const {
  std::vector<int> votes(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  const auto vote = [&](const Eigen::Vector3f& point, int weight) {
    const Cell cell = cell_of(point);
    if (cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_) {
      votes[index_of(cell.x, cell.y, columns_)] += weight;
    }
  };
  for (int v = 0; v < image.height; v += kStride) {
    for (int u = 0; u < image.width; u += kStride) {
      if (const auto crossing = evidence.crossing(u, v)) {
        vote(crossing->point, crossing->may_be_table ? 1 : -1);
      }
      if (evidence.is_just_below(u, v)) {
        vote(intrinsics.point(u, v, image.at(u, v)), -1);
      }
    }
  }
  std::vector<std::uint8_t> possible(votes.size());
  std::ranges::transform(votes, possible.begin(), [](int sum) -> std::uint8_t { return sum > 0 ? 1 : 0; });
  return possible;
}

TableArea::Cell TableArea::cell_of(const Eigen::Vector3f& point) const {
  return {static_cast<int>(std::floor((x_axis_.dot(point) - low_.x()) / cell_)),
          static_cast<int>(std::floor((y_axis_.dot(point) - low_.y()) / cell_))};
}

TableArea::Place TableArea::place_of(const Eigen::Vector3f& point) const {
  const Cell cell = cell_of(point);
  const bool is_in_grid = !cells_.empty() && cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_;
  return is_in_grid ? cells_[index_of(cell.x, cell.y, columns_)] : Place::outside;
}

}  // namespace spincat
