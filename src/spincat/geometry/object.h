// What a file of a 3D object holds: a mesh or a point cloud, in the file's own unit.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

// Positions from files are doubles: coordinates of 1e30 or far from the origin keep their shape until they are scaled.
using Vec3 = Eigen::Vector3d;

// The axis of a file that points up, where it is known.
enum class UpAxis { none, x, y, z };

// Three indices into Mesh::vertices. The front of the face is where the corners run counter-clockwise.
using Triangle = std::array<std::uint32_t, 3>;

// A triangle soup. Every index is < vertices.size() and every coordinate finite (readers check both); triangles may
// still be repeated, flipped or without area, and vertices may be repeated or unused. `left_out` says which of the
// file's points are not among these, ascending: those that are not finite.
//
//   a unit square:  vertices   4 x (x, y, z)   {0,0,0} {1,0,0} {1,1,0} {0,1,0}
//                   triangles  2 x 3           {0,1,2} {0,2,3}
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> left_out = {};
};

// Points without faces. `normals` is empty or has one vector a point; a vector need not have unit length, and one
// that is zero or not finite means "not known". `sensor` is where the points were seen from, in the same frame, where
// the file tells it. `left_out` as in Mesh.
struct PointCloud {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  std::optional<Vec3> sensor;
  std::vector<std::uint32_t> left_out = {};
};

using Object = std::variant<Mesh, PointCloud>;

}  // namespace spincat
#pragma GCC visibility pop
