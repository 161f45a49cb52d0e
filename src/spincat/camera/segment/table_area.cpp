#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "spincat/camera/segment/table.h"

namespace spincat {
namespace {

constexpr float kCell = 0.02F;            // metres
constexpr int kGrown = 2;                 // cells that the area is wider than what is seen
constexpr int kMostCells = 1'000;         // along an axis: 20 m
constexpr int kLeastNeighbours = 7;       // filled cells among a cell's 3 x 3 for it to count
constexpr double kLeastComponent = 0.01;  // of the largest component, for another to count
constexpr int kFat = 3;     // cells around a cell that must be filled for a component to be more than a strip
constexpr int kStride = 2;  // every second pixel both ways is looked at

struct GridPoint {
  int x;
  int y;
  auto operator<=>(const GridPoint&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer
};

std::size_t index_of(int x, int y, int columns) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
}

long long cross(const GridPoint& o, const GridPoint& a, const GridPoint& b) {
  return static_cast<long long>(a.x - o.x) * (b.y - o.y) - static_cast<long long>(a.y - o.y) * (b.x - o.x);
}

// The corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<GridPoint> convex_hull(std::vector<GridPoint> points) {
  std::ranges::sort(points);
  std::vector<GridPoint> hull(2 * points.size() + 1);
  std::size_t k = 0;
  const auto add = [&](const GridPoint& p, std::size_t fixed) {
    while (k >= fixed + 2 && cross(hull[k - 2], hull[k - 1], p) <= 0) {
      --k;
    }
    hull[k++] = p;
  };
  for (const GridPoint& p : points) {
    add(p, 0);
  }
  const std::size_t lower = k - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) {
    add(*p, lower);
  }
  hull.resize(k - 1);
  return hull;
}

bool inside(const std::vector<GridPoint>& hull, const GridPoint& p) {
  for (std::size_t k = 0; k < hull.size(); ++k) {
    if (cross(hull[k], hull[(k + 1) % hull.size()], p) < 0) {
      return false;
    }
  }
  return true;
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

// Whether somewhere in a component a square of 14 cm is filled but for a tenth. What is not so wide is a strip: where a
// wall or a cupboard passes through the plane of the table.
bool is_fat(const std::vector<GridPoint>& component, const Grid& grid) {
  constexpr int kSide = 2 * kFat + 1;
  constexpr int kFilled = kSide * kSide * 9 / 10;
  const auto filled_around = [&](const GridPoint& c) {
    int filled = 0;
    for (int y = c.y - kFat; y <= c.y + kFat; ++y) {
      for (int x = c.x - kFat; x <= c.x + kFat; ++x) {
        filled += grid.at(x, y) != 0 ? 1 : 0;
      }
    }
    return filled >= kFilled;
  };
  return std::ranges::any_of(component.rbegin(), component.rend(), filled_around);
}

// Those of the cells that belong to a component (4 neighbours) of at least kLeastComponent of the largest that is no
// strip, and the largest.
std::vector<GridPoint> large_components(const std::vector<GridPoint>& cells, Grid grid) {
  std::ranges::fill(grid.cells, 0);
  for (const GridPoint& c : cells) {
    grid.cells[grid.index(c.x, c.y)] = 1;
  }
  std::vector<std::vector<GridPoint>> components;
  for (const GridPoint& c : cells) {
    if (grid.at(c.x, c.y) != 1) {
      continue;
    }
    std::vector<GridPoint> component;
    const auto take = [&](GridPoint p) {
      if (grid.at(p.x, p.y) == 1) {
        grid.cells[grid.index(p.x, p.y)] = 2;
        component.push_back(p);
      }
    };
    take(c);
    for (std::size_t k = 0; k < component.size(); ++k) {
      const GridPoint p = component[k];
      for (const GridPoint& next : {GridPoint{p.x + 1, p.y}, {p.x - 1, p.y}, {p.x, p.y + 1}, {p.x, p.y - 1}}) {
        take(next);
      }
    }
    components.push_back(std::move(component));
  }
  std::size_t largest = 0;
  for (const auto& component : components) {
    largest = std::max(largest, component.size());
  }
  std::vector<GridPoint> kept;
  for (const auto& component : components) {
    const bool large = static_cast<double>(component.size()) >= kLeastComponent * static_cast<double>(largest);
    if (component.size() == largest || (large && is_fat(component, grid))) {
      kept.insert(kept.end(), component.begin(), component.end());
    }
  }
  return kept;
}

}  // namespace

TableArea::TableArea(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table)
    : x_axis_(table.normal.unitOrthogonal()), y_axis_(table.normal.cross(x_axis_)) {
  std::vector<std::uint8_t> filled = filled_cells(image, intrinsics, table);
  const Grid grid{columns_, rows_, filled};
  const std::vector<GridPoint> seen = large_components(dense_cells(grid), grid);
  if (seen.empty()) {
    return;
  }
  std::vector<GridPoint> grown;
  for (const GridPoint& c : seen) {
    for (const auto& [dx, dy] :
         {std::array{-kGrown, -kGrown}, {-kGrown, kGrown}, {kGrown, -kGrown}, {kGrown, kGrown}}) {
      grown.push_back({c.x + dx, c.y + dy});
    }
  }
  const std::vector<GridPoint> hull = convex_hull(std::move(grown));
  cells_.assign(filled.size(), 0);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      cells_[index_of(x, y, columns_)] = inside(hull, {x, y}) ? 1 : 0;
    }
  }
}

// Chooses the grid around the readings on the table, and fills the cells that hold one.
std::vector<std::uint8_t> TableArea::filled_cells(const DepthImage& image, const Intrinsics& intrinsics,
                                                  const SupportPlane& table) {
  std::vector<Eigen::Vector2f> on_table;
  for (int v = 0; v < image.height; v += kStride) {
    for (int u = 0; u < image.width; u += kStride) {
      const float z = image.at(u, v);
      const Eigen::Vector3f p = intrinsics.point(u, v, z);
      if (z > 0.0F && std::abs(table.height(p)) < plane_tolerance(z)) {
        on_table.emplace_back(x_axis_.dot(p), y_axis_.dot(p));
      }
    }
  }
  if (on_table.empty()) {
    return {};
  }
  Eigen::Vector2f low = on_table.front();
  Eigen::Vector2f high = low;
  for (const Eigen::Vector2f& p : on_table) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  constexpr int kMargin = kGrown + 1;
  low_ = low.array() - kMargin * kCell;
  columns_ = std::min(static_cast<int>((high.x() - low.x()) / kCell) + 2 * kMargin + 1, kMostCells);
  rows_ = std::min(static_cast<int>((high.y() - low.y()) / kCell) + 2 * kMargin + 1, kMostCells);
  std::vector<std::uint8_t> filled(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  for (const Eigen::Vector2f& p : on_table) {
    const int x = static_cast<int>((p.x() - low_.x()) / kCell);
    const int y = static_cast<int>((p.y() - low_.y()) / kCell);
    if (x < columns_ && y < rows_) {
      filled[index_of(x, y, columns_)] = 1;
    }
  }
  return filled;
}

TableArea::Cell TableArea::cell_of(const Eigen::Vector3f& point) const {
  return {static_cast<int>(std::floor((x_axis_.dot(point) - low_.x()) / kCell)),
          static_cast<int>(std::floor((y_axis_.dot(point) - low_.y()) / kCell))};
}

bool TableArea::contains(const Eigen::Vector3f& point) const {
  const Cell cell = cell_of(point);
  return !cells_.empty() && cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_ &&
         cells_[index_of(cell.x, cell.y, columns_)] != 0;
}

}  // namespace spincat
