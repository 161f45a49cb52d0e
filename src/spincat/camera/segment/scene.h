// What is found in a frame, a table and the objects on it, and by which settings.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

// All points x with normal . x + offset = 0, in metres in the camera's frame. The normal has length 1 and points to the
// side of the camera.
struct SupportPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0.0F;
  double share = 0.0;  // of the readings that lie on it, near ones counting more

  float height(const Eigen::Vector3f& point) const { return normal.dot(point) + offset; }
};

// What objects stand on.
enum class SceneKind {
  automatic,  // the plane with most readings, or a table high over it that is seen well
  table,      // the highest plane that is seen well enough
  floor,      // the lowest
};

struct TableSettings {
  std::optional<Eigen::Vector3f> up;  // what is up in the camera's frame; without it, the camera is not upside down
  SceneKind scene = SceneKind::automatic;
  double least_share = 0.1;  // of the readings, below which no plane is a table
  int trials = 200;          // of RANSAC, at least; five times as many where no plane holds much
  std::uint64_t seed = 1;
};

// How readings that hang together are parted into objects.
enum class SegmentSplit {
  concave,  // along grooves: for things that touch or stand on each other, like boxes
  none,     // by what stands apart on the table: for things with legs and thin parts, like furniture
};

struct SegmentSettings {
  SegmentSplit split = SegmentSplit::none;
  float least_area = 0.0004F;   // square metres of an object, as they face the camera
  float least_height = 0.015F;  // metres over the table that an object reaches
  float most_height = 2.0F;     // metres over the table; what is higher is not looked at

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

// A box that stands upright on a plane, in metres in the camera's frame.
struct OrientedBox {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  // columns: the longer side along the plane, the shorter, up;
                                                       // right-handed
  Eigen::Vector3f size = Eigen::Vector3f::Zero();      // along the axes
};

// One object, as the camera sees it.
struct Segment {
  std::uint16_t id = 0;  // in Segmentation::ids
  std::size_t pixels = 0;
  int left = 0, top = 0, right = 0, bottom = 0;      // its box of pixels, all inclusive
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  // mean of its points, in metres in the camera's frame
  float height = 0.0F;                               // of its highest point over the table, in metres
  OrientedBox box;                                   // around what is seen of it
  bool cut = false;                                  // touches the picture's border: there may be more of it
};

// Pixels that are no object, by the reason.
struct NotObjects {
  std::size_t outside = 0;   // over the plane, but not over the part of the table that is seen, or of walls behind it
  std::size_t too_few = 0;   // in patches of less than least_area
  std::size_t too_low = 0;   // in patches that stay below least_height
  std::size_t too_high = 0;  // over the table's area, but higher than most_height
};

struct Segmentation {
  std::vector<std::uint16_t> ids;        // of each pixel: that of its object, or 0
  std::vector<Segment> objects;          // in the order of their ids, 1, 2, ...
  std::vector<Eigen::Vector3f> outline;  // corners of the part of the table that is seen, counter-clockwise from above
  NotObjects left_out;
};

// How objects are followed from frame to frame.
struct TrackSettings {
  float most_step = 0.12F;  // metres that an object moves from one frame to the next
  int most_missing = 15;    // frames that it may not be seen before it is forgotten
};

}  // namespace spincat
#pragma GCC visibility pop
