// The plane that objects stand on, and the part of it that the camera sees.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "spincat/camera/segment/hull.h"
#include "spincat/camera/segment/scene.h"
#include "spincat/camera/source/frame_source.h"

namespace spincat {

// How far a reading of a plane at depth z may lie from it: what a structured-light sensor's noise amounts to.
inline float plane_tolerance(float z) {
  return 0.004F + 0.005F * z * z;
}

// Pixels at depth z that a length in metres takes up in the picture, at least `least` and at most 1,000.
inline int pixels_of(float length, float z, double focal_length, int least) {
  return static_cast<int>(
      std::lround(std::clamp(length * static_cast<float>(focal_length) / z, static_cast<float>(least), 1000.0F)));
}

// The plane with most readings on it, each weighted by 1 / z^2: the best of random triples, any and close ones (RANSAC,
// Fischler and Bolles 1981), each better one refined by least squares (Chum, Matas and Kittler 2003); then, as
// `settings.scene` has it, a plane along it that is higher or lower. `before`, the table of the frame before, is kept
// where hardly another is better. No table where there are too few readings, or none of the planes holds least_share of
// them. Deterministic.
std::optional<SupportPlane> find_table(const DepthImage& image, const Intrinsics& intrinsics,
                                       const TableSettings& settings, const std::optional<SupportPlane>& before = {});

// The convex hull of what is seen of a table, in cells of 2 cm (10 cm at most for a far floor), and a rim of 12 cm.
// Pieces of the table that things part are seen together; what the camera sees the floor or a wall before is no piece
// of it.
class TableArea {
 public:
  TableArea(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table);

  enum class Place : std::uint8_t { outside, rim, inside };
  // Where the point lies above (or below) the plane.
  Place place_of(const Eigen::Vector3f& point) const;
  // The same for a place along the plane, by axes of its own.
  Place place_at(const Eigen::Vector2f& place) const;
  const Eigen::Vector3f& x_axis() const { return x_axis_; }
  const Eigen::Vector3f& y_axis() const { return y_axis_; }
  bool empty() const { return cells_.empty(); }
  // The corners of what is seen, without the rim, on the plane and in the camera's frame.
  const std::vector<Eigen::Vector3f>& outline() const { return outline_; }

 private:
  struct Cell {
    int x;
    int y;
  };
  Cell cell_of(const Eigen::Vector2f& place) const;
  class Evidence;
  Eigen::Vector3f point_of(int x, int y, const SupportPlane& table) const;
  int rim_cells() const;
  void mark(const std::vector<GridPoint>& hull, Place place);
  std::vector<std::uint8_t> filled_cells(const DepthImage& image, const Intrinsics& intrinsics, float camera_height,
                                         const Evidence& evidence);
  std::vector<std::uint8_t> possible_cells(const DepthImage& image, const Evidence& evidence) const;

  Eigen::Vector3f x_axis_;
  Eigen::Vector3f y_axis_;
  float cell_ = 0.0F;  // metres
  Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Place> cells_;  // rows_ x columns_
  std::vector<Eigen::Vector3f> outline_;
};

}  // namespace spincat
