// The plane that objects stand on, and the part of it that the camera sees.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "spincat/camera/segment/scene.h"
#include "spincat/camera/source/frame_source.h"

namespace spincat {

// How far a reading of a plane at depth z may lie from it: what a structured-light sensor's noise amounts to.
inline float plane_tolerance(float z) {
  return 0.004F + 0.005F * z * z;
}

// The plane with most readings on it, each weighted by 1 / z^2: the best of random triples (RANSAC, Fischler and Bolles
// 1981), refined by least squares. `before`, the table of the frame before, is kept where hardly another is better. No
// table where there are too few readings, or none of the planes holds least_share of them. Deterministic.
std::optional<SupportPlane> find_table(const DepthImage& image, const Intrinsics& intrinsics,
                                       const TableSettings& settings, const std::optional<SupportPlane>& before = {});

// The convex hull of what is seen of a table, in cells of 2 cm, two cells wider all round.
class TableArea {
 public:
  TableArea(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table);

  // Whether the point lies above (or below) the area.
  bool contains(const Eigen::Vector3f& point) const;
  bool empty() const { return cells_.empty(); }

 private:
  struct Cell {
    int x;
    int y;
  };
  Cell cell_of(const Eigen::Vector3f& point) const;
  std::vector<std::uint8_t> filled_cells(const DepthImage& image, const Intrinsics& intrinsics,
                                         const SupportPlane& table);

  Eigen::Vector3f x_axis_;
  Eigen::Vector3f y_axis_;
  Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> cells_;  // rows_ x columns_: 1 inside
};

}  // namespace spincat
