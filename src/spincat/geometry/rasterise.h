// Drawing triangles: which pixels of a picture a projected triangle covers, and how far away it is there.
#pragma once

#include <algorithm>
#include <cstddef>

#include "spincat/geometry/object.h"

namespace spincat {

// A run of pixels in a row; empty when last < first.
struct Columns {
  int first;
  int last;
};

// The weights of a projected triangle's corners at the pixel centres of one row: all at least zero inside and on its
// edge. They are linear, and so is one over the depth. Counted from the first column that is asked for.
class RowWeights {
 public:
  RowWeights(double b, double c, double step_b, double step_c) : b_(b), c_(c), step_b_(step_b), step_c_(step_c) {}

  // The columns among the first `count` that are not outside.
  Columns inside(int count) const {
    constexpr int kFew = 6;  // that are tested faster than the crossings are computed
    Columns columns{0, count - 1};
    if (count > kFew) {
      narrow(columns);
    }
    while (columns.first <= columns.last && !is_inside(columns.first)) {
      ++columns.first;
    }
    while (columns.first < columns.last && !is_inside(columns.last)) {
      --columns.last;
    }
    return columns;
  }

  double b(int column) const { return b_ + column * step_b_; }
  double c(int column) const { return c_ + column * step_c_; }

 private:
  bool is_inside(int column) const {
    const double wb = b(column);
    const double wc = c(column);
    return wb >= -kRounding && wc >= -kRounding && wb + wc <= 1.0 + kRounding;
  }

  // So that two triangles that share an edge leave no crack between them.
  static constexpr double kRounding = 1e-10;

  // Leaves out columns that are more than a pixel outside, so that rounding decides about none: a long thin triangle
  // costs its length, not its bounding box.
  void narrow(Columns& columns) const {
    const int count = columns.last + 1;
    cut(b_, step_b_, count, columns);
    cut(c_, step_c_, count, columns);
    cut(1.0 - b_ - c_, -step_b_ - step_c_, count, columns);
  }

  // The same for one weight that is `weight` at column 0 and changes by `step` a column.
  static void cut(double weight, double step, int count, Columns& columns) {
    if (step == 0.0) {
      return;
    }
    const int at = static_cast<int>(std::clamp(-weight / step, -2.0, 2.0 * count));
    if (step > 0.0) {
      columns.first = std::max(columns.first, at - 2);
    } else {
      columns.last = std::min(columns.last, at + 2);
    }
  }

  double b_;  // the weights of the second and third corner at column 0
  double c_;
  double step_b_;  // from one column to the next
  double step_c_;
};

// The range of pixels whose centres lie between two picture coordinates, cut to a picture of `count` pixels. (std::ceil
// and std::floor are function calls on the processors that this is compiled for.)
inline int first_pixel(double low, int count) {
  const double at = std::clamp(low - 0.5, 0.0, static_cast<double>(count));
  const int below = static_cast<int>(at);
  return below < at ? below + 1 : below;
}
inline int last_pixel(double high, int count) {
  return static_cast<int>(std::clamp(high + 0.5, 0.0, static_cast<double>(count))) - 1;
}

// Draws both sides of a triangle to a picture of columns x rows: calls keep(pixel, inverse_depth) for every pixel whose
// centre lies inside or on its edge. Corners are (x, y, 1 / depth), where pixel (c, r), number r columns + c, has its
// centre at (c + .5, r + .5): one over the depth is linear over the picture of a plane. Precondition: depths > 0.
template <class Keep>
void draw_triangle(int columns, int rows, const Vec3& a, const Vec3& b, const Vec3& c, const Keep& keep) {
  const int first_column = first_pixel(std::min({a.x(), b.x(), c.x()}), columns);
  const int last_column = last_pixel(std::max({a.x(), b.x(), c.x()}), columns);
  const int first_row = first_pixel(std::min({a.y(), b.y(), c.y()}), rows);
  const int last_row = last_pixel(std::max({a.y(), b.y(), c.y()}), rows);
  if (first_column > last_column || first_row > last_row) {
    return;
  }
  const double twice_area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (twice_area == 0.0) {
    return;
  }
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double scale = 1.0 / twice_area;  // its sign makes the weights of either winding positive inside
  const double step_b = ac.y() * scale;
  const double step_c = -ab.y() * scale;
  const double x = first_column + 0.5 - a.x();
  const double depth_step = step_b * ab.z() + step_c * ac.z();
  for (int row = first_row; row <= last_row; ++row) {
    const double y = row + 0.5 - a.y();
    const RowWeights weights((x * ac.y() - y * ac.x()) * scale, (ab.x() * y - ab.y() * x) * scale, step_b, step_c);
    const Columns inside = weights.inside(last_column - first_column + 1);
    const double nearest = a.z() + weights.b(inside.first) * ab.z() + weights.c(inside.first) * ac.z();
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(first_column);
    for (int column = inside.first; column <= inside.last; ++column) {
      keep(first + static_cast<std::size_t>(column), nearest + (column - inside.first) * depth_step);
    }
  }
}

}  // namespace spincat
