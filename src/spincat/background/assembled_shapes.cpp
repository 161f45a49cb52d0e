// Simple bodies put together at random: what resembles nothing in particular.
#include <algorithm>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

// A body of any simple kind around the origin, about as large as `size`, turned at random.
Mesh body(Random& random, double size) {
  const Vec3 sizes = vector(random, 0.2, 1.0) * size;
  Mesh mesh;
  switch (whole(random, 0, 4)) {
    case 0:
      mesh = box({0, 0, 0}, 2.0 * sizes);
      break;
    case 1:
      mesh = ellipsoid({0, 0, 0}, sizes);
      break;
    case 2:
      mesh = rod({0, 0, -sizes.z()}, {0, 0, sizes.z()}, sizes.x(), random.uniform(0.0, 1.0) * sizes.y());
      break;
    case 3:
      mesh = ring(0.7 * size, 0.25 * sizes.x());
      break;
    default:
      mesh = lathe({{0, -sizes.z()}, {sizes.x(), -sizes.z()}, {sizes.y(), sizes.z()}, {0, sizes.z()}},
                   whole(random, 3, 6));
  }
  // Things that people make mostly stand at right angles.
  if (chance(random, 0.5)) {
    const int quarters = whole(random, 0, 3);
    return turned(mesh, 0.25 * quarters, chance(random, 0.5) ? Vec3::UnitX() : Vec3::UnitY());
  }
  const Vec3 axis = direction(random);
  return turned(mesh, random.uniform(), axis);
}

// A chain of bodies that touch or overlap, the first one around the origin.
Mesh bodies(Random& random, int count) {
  Mesh mesh;
  Vec3 place = Vec3::Zero();
  for (; count > 0; --count) {
    const double size = random.uniform(0.25, 0.8);
    add(mesh, moved(body(random, size), place));
    place += direction(random) * (0.7 * size);
  }
  return mesh;
}

// How far up a mesh reaches.
double top_of(const Mesh& mesh) {
  double top = -1e9;
  for (const Vec3& v : mesh.vertices) {
    top = std::max(top, v.z());
  }
  return top;
}

}  // namespace

Mesh stack(Random& random) {
  Mesh mesh = body(random, random.uniform(0.2, 0.8));
  for (int k = whole(random, 1, 5); k > 0; --k) {
    const Mesh next = body(random, random.uniform(0.2, 0.8));
    const double below = top_of(turned(next, 0.5, Vec3::UnitX()));
    add(mesh, moved(next, Vec3{0, 0, top_of(mesh) + 0.95 * below}));
  }
  return mesh;
}

Mesh cluster(Random& random) {
  const Vec3 squeeze = vector(random, 0.3, 1.0);
  return stretched(bodies(random, whole(random, 2, 9)), squeeze);
}

Mesh mirror_cluster(Random& random) {
  const double apart = random.uniform(0.1, 0.6);
  Mesh mesh = mirrored(moved(bodies(random, whole(random, 1, 4)), Vec3{apart, 0, 0}));
  add(mesh, body(random, random.uniform(0.3, 1.0)));
  return mesh;
}

Mesh star_cluster(Random& random) {
  const double far = random.uniform(0.3, 1.2);
  Mesh part = moved(bodies(random, whole(random, 1, 3)), Vec3{far, 0, 0});
  add(part, rod({0, 0, 0}, {far, 0, 0}, random.uniform(0.04, 0.2)));
  Mesh mesh = around(part, whole(random, 3, 9));
  if (chance(random, 0.6)) {
    const double low = -random.uniform(0.1, 1.0);
    const double high = random.uniform(0.1, 1.0);
    add(mesh, rod({0, 0, low}, {0, 0, high}, random.uniform(0.05, 0.5)));
  }
  return mesh;
}

// A frame of bars between random joints.
Mesh rods(Random& random) {
  std::vector<Vec3> joints;
  const Vec3 size = vector(random, 0.2, 1.0);
  for (int k = whole(random, 4, 9); k > 0; --k) {
    joints.push_back(vector(random, -1.0, 1.0).cwiseProduct(size));
  }
  const double bar = random.uniform(0.02, 0.12);
  const bool balls = chance(random, 0.5);
  Mesh mesh;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (std::size_t j = i + 1; j < joints.size(); ++j) {
      if (j == i + 1 || chance(random, 0.25)) {
        add(mesh, rod(joints[i], joints[j], bar));
      }
    }
    if (balls) {
      add(mesh, ellipsoid(joints[i], Vec3::Constant(bar * random.uniform(1.5, 3.0))));
    }
  }
  return chance(random, 0.4) ? mirrored(mesh) : mesh;
}

}  // namespace spincat::background
