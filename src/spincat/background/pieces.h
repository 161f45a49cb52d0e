// What background shapes are put together from: simple surfaces, and ways to move, repeat and join them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/geometry/random.h"

namespace spincat::background {

using Vec2 = Eigen::Vector2d;

// A whole number from `low` to `high`, both included; whether something happens that happens with the probability `p`;
// three independent numbers in [low, high); a direction, evenly distributed. Deterministic.
int whole(Random& random, int low, int high);
bool chance(Random& random, double p);
Vec3 vector(Random& random, double low, double high);
Vec3 direction(Random& random);

// A point of the unit circle at an angle in turns.
Vec2 on_circle(double turns);

// A grid of (rows + 1) x (columns + 1) points with two triangles a cell; `place` is asked for (u, v) in [0, 1]^2.
Mesh surface(int rows, int columns, const std::function<Vec3(double u, double v)>& place);

// A closed surface around the origin: as far away in each direction as `radius` says of it.
Mesh globe(const std::function<double(const Vec3& direction)>& radius);
Mesh ellipsoid(const Vec3& centre, const Vec3& radii);
Mesh box(const Vec3& centre, const Vec3& size);

// What a profile of (radius, height) sweeps when it turns about z; few sides make a prism or a pyramid of it.
Mesh lathe(const std::vector<Vec2>& profile, int sides = 24);

// A closed tube along a path, with a radius for each of its points; a rod is a straight one. The path has two points or
// more, no two following ones at one place.
Mesh tube(const std::vector<Vec3>& path, const std::vector<double>& radii, int sides = 8);
Mesh tube(const std::vector<Vec3>& path, double radius, int sides = 8);
Mesh rod(const Vec3& from, const Vec3& to, double radius, double end_radius);
inline Mesh rod(const Vec3& from, const Vec3& to, double radius) {
  return rod(from, to, radius, radius);
}

// A ring about z, in the plane z = 0: a tube of the radius `thickness` along a circle.
Mesh ring(double radius, double thickness);

// A plate with the outline, centred in z; `hole` is the share of the outline's size that is cut out of its middle. From
// the origin every point of the outline can be seen.
Mesh plate(const std::vector<Vec2>& outline, double thickness, double hole = 0.0);

// A thin bent sheet along z -> x: `length` long, as wide as `width` where it is widest, hanging down by `droop`.
Mesh leaf(double length, double width, double droop);

// A smooth curve through all points (Catmull-Rom), eight pieces between two of them.
std::vector<Vec3> smooth(const std::vector<Vec3>& points);

void add(Mesh& mesh, const Mesh& piece);
Mesh moved(Mesh mesh, const Eigen::Affine3d& motion);
Mesh moved(Mesh mesh, const Vec3& by);
Mesh stretched(Mesh mesh, const Vec3& by);
Mesh turned(Mesh mesh, double turns, const Vec3& axis);

// The mesh and its mirror image at x = 0; `count` of it, evenly around z.
Mesh mirrored(Mesh mesh);
Mesh around(const Mesh& mesh, int count);

}  // namespace spincat::background
