// What a mesh encloses, whether it is watertight or not.
#pragma once

#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// The places from which the mesh's surface is met along each of 26 directions: those of a cube's corners, edges and
// sides, seen from its middle. Found by pictures of 64 x 64 pixels, so what is thinner than a thirtieth of the radius
// may be overlooked. Precondition: the mesh is normalised (within distance 1 of the origin). Deterministic.
class EnclosedSpace {
 public:
  explicit EnclosedSpace(const Mesh& mesh);

  bool contains(const Vec3& p) const;
  // All corners of the box, and its middle.
  bool contains(const Vec3& low, const Vec3& high) const;

 private:
  // Along one of 13 lines: where at each pixel the surface begins and ends.
  struct Picture {
    Eigen::Matrix3d axes;  // rows: right, down, along the line
    std::vector<double> first;
    std::vector<double> last;
  };

  std::vector<Picture> pictures_;
};

}  // namespace spincat
