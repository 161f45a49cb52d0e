// Trees, flowers and mushrooms, growing up z.
#include <cmath>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

struct Growth {
  int forks;      // branches that leave the end of one
  double spread;  // how far they lean aside
  double shrink;  // how much shorter and thinner they are
};

// A branch and all that grow out of it. Returns where the last ones end in `tips`.
void grow(Random& random, Mesh& mesh, const Vec3& from, const Vec3& along, double radius, int depth,
          const Growth& growth, std::vector<Vec3>& tips) {
  const Vec3 to = from + along;
  add(mesh, tube({from, to}, {radius, growth.shrink * radius}, depth > 1 ? 8 : 5));
  if (depth == 0) {
    tips.push_back(to);
    return;
  }
  for (int k = 0; k < growth.forks; ++k) {
    const Vec3 aside = direction(random) * growth.spread;
    const double length = along.norm() * growth.shrink * random.uniform(0.7, 1.2);
    grow(random, mesh, to, (along.normalized() + aside).normalized() * length, growth.shrink * radius, depth - 1,
         growth, tips);
  }
}

Growth random_growth(Random& random) {
  const int forks = whole(random, 2, 3);
  const double spread = random.uniform(0.4, 1.1);
  return {forks, spread, random.uniform(0.55, 0.85)};
}

// `count` leaves around z at the height `z`, leaning as they please.
Mesh tuft(Random& random, int count, double length, double z) {
  Mesh mesh;
  const double width = length * random.uniform(0.05, 0.45);
  const double droop = random.uniform(0.0, 1.6);
  for (int k = 0; k < count; ++k) {
    const double reach = length * random.uniform(0.6, 1.0);
    const Mesh one = leaf(reach, width, droop * random.uniform(0.5, 1.2));
    const Mesh raised = turned(one, -random.uniform(0.0, 0.2), Vec3::UnitY());
    const double turns = k / static_cast<double>(count) + random.uniform(0.0, 0.1);
    add(mesh, moved(turned(raised, turns, Vec3::UnitZ()), Vec3{0, 0, z}));
  }
  return mesh;
}

Mesh pot(Random& random) {
  const double foot = random.uniform(0.3, 0.9);
  const double height = random.uniform(0.4, 1.4);
  return lathe({{0, -height}, {0.6 * foot, -height}, {0.6, -0.1}, {0.7, -0.1}, {0.7, 0}, {0, -0.05}},
               chance(random, 0.2) ? 4 : 20);
}

}  // namespace

Mesh bare_tree(Random& random) {
  Mesh mesh;
  std::vector<Vec3> tips;
  const Growth growth = random_growth(random);
  const int depth = growth.forks == 2 ? whole(random, 3, 5) : whole(random, 2, 3);
  const Vec3 trunk{0, 0, random.uniform(0.5, 1.5)};
  const double radius = random.uniform(0.05, 0.2);
  grow(random, mesh, Vec3::Zero(), trunk, radius, depth, growth, tips);
  return mesh;
}

Mesh leafy_tree(Random& random) {
  Mesh mesh;
  std::vector<Vec3> tips;
  const Growth growth = random_growth(random);
  const Vec3 trunk{0, 0, random.uniform(0.3, 1.5)};
  const double radius = random.uniform(0.05, 0.15);
  grow(random, mesh, Vec3::Zero(), trunk, radius, growth.forks == 2 ? 3 : 2, growth, tips);
  const double size = random.uniform(0.15, 0.6);
  const double flat = random.uniform(0.3, 1.0);
  for (const Vec3& tip : tips) {
    const double s = size * random.uniform(0.7, 1.2);
    add(mesh, ellipsoid(tip, {s, s, flat * s}));
  }
  return mesh;
}

Mesh conifer(Random& random) {
  const double height = random.uniform(1.5, 4.0);
  const int floors = whole(random, 1, 7);
  std::vector<Vec2> profile;
  for (int k = 0; k < floors; ++k) {
    const double share = 1.0 - k / static_cast<double>(floors);
    profile.emplace_back(share, height * (1.0 - share));
    profile.emplace_back(share * random.uniform(0.3, 0.7), height * (1.0 - share + 0.8 / floors));
  }
  profile.emplace_back(0.0, height);
  profile.insert(profile.begin(), {0.0, 0.1 * height});
  Mesh mesh = lathe(profile, whole(random, 5, 20));
  const double trunk = random.uniform(0.2, 1.0);
  add(mesh, rod({0, 0, -trunk}, {0, 0, 0.3}, random.uniform(0.08, 0.2)));
  return mesh;
}

Mesh palm(Random& random) {
  const double height = random.uniform(1.0, 3.0);
  const double lean = random.uniform(-0.5, 0.5);
  Mesh mesh = tube(smooth({{lean, 0, 0}, {0.3 * lean, 0, 0.5 * height}, {0, 0, height}}), random.uniform(0.05, 0.15));
  const int leaves = whole(random, 5, 14);
  const double length = random.uniform(0.7, 1.5);
  add(mesh, tuft(random, leaves, length, height));
  return mesh;
}

Mesh potted_plant(Random& random) {
  Mesh mesh = pot(random);
  const double height = random.uniform(0.0, 1.0);
  add(mesh, rod({0, 0, -0.1}, {0, 0, height}, 0.05));
  for (int k = whole(random, 1, 3); k > 0; --k) {
    const int leaves = whole(random, 4, 12);
    const double length = random.uniform(0.6, 1.6);
    const double z = height * random.uniform(0.3, 1.0);
    add(mesh, tuft(random, leaves, length, z));
  }
  return mesh;
}

Mesh flower(Random& random) {
  Mesh mesh;
  const int flowers = whole(random, 1, 4);
  for (int k = 0; k < flowers; ++k) {
    const Vec3 lean = flowers == 1 ? Vec3(Vec3::Zero()) : vector(random, -0.6, 0.6);
    const Vec3 top(lean.x(), lean.y(), random.uniform(1.2, 2.5));
    add(mesh, tube(smooth({{0, 0, 0}, {0.2 * lean.x(), 0.2 * lean.y(), 0.6 * top.z()}, top}), 0.03, 6));
    const int petals = whole(random, 5, 12);
    const double length = random.uniform(0.3, 0.7);
    Mesh blossom = tuft(random, petals, length, 0.0);
    add(blossom, ellipsoid({0, 0, 0}, {0.12, 0.12, 0.08}));
    const double tilt = random.uniform(-0.15, 0.15);
    add(mesh, moved(turned(blossom, tilt, Vec3::UnitX()), top));
  }
  const int leaves = whole(random, 0, 4);
  add(mesh, tuft(random, leaves, 0.8, 0.2));
  return mesh;
}

Mesh mushrooms(Random& random) {
  Mesh mesh;
  for (int k = whole(random, 1, 4); k > 0; --k) {
    const double size = random.uniform(0.3, 1.0);
    const double height = size * random.uniform(0.6, 2.0);
    const double flat = random.uniform(0.3, 1.0);
    Mesh one = rod({0, 0, 0}, {0, 0, height}, 0.35 * size, 0.2 * size);
    add(one, lathe({{0.15 * size, height},
                    {size, height - 0.1 * size},
                    {0.9 * size, height + 0.35 * flat * size},
                    {0.5 * size, height + 0.7 * flat * size},
                    {0, height + 0.8 * flat * size}}));
    const Vec3 place = vector(random, -0.8, 0.8);
    add(mesh, moved(turned(one, random.uniform(-0.06, 0.06), Vec3::UnitX()), Vec3{place.x(), place.y(), 0}));
  }
  return mesh;
}

}  // namespace spincat::background
