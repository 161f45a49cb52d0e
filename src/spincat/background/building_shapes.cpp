// Buildings and what stands in streets, up z.
#include <cmath>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

// Walls with a roof on them, `ridge` being the ridge's share of the length: 1 a gable, 0 a pyramid.
Mesh roofed(const Vec3& foot, const Vec3& size, double roof, double ridge) {
  constexpr double kEaves = 0.56;  // half of the size and a little over
  Mesh top;
  for (const double x : {-1.0, 1.0}) {
    top.vertices.emplace_back(kEaves * x * size.x(), -kEaves * size.y(), size.z());
    top.vertices.emplace_back(kEaves * x * size.x(), kEaves * size.y(), size.z());
    top.vertices.emplace_back(kEaves * ridge * x * size.x(), 0.0, size.z() + roof);
  }
  top.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}, {0, 3, 4}, {0, 4, 1}};
  add(top, box({0, 0, 0.5 * size.z()}, size));
  return moved(top, foot);
}

Mesh column(const Vec3& foot, double height, double radius) {
  return moved(lathe({{0, 0},
                      {1.4 * radius, 0},
                      {1.4 * radius, 0.1},
                      {radius, 0.1},
                      {0.85 * radius, height - 0.1},
                      {1.4 * radius, height - 0.1},
                      {1.4 * radius, height},
                      {0, height}},
                     12),
               foot);
}

Mesh tower(Random& random, const Vec3& foot, double radius, double height) {
  const double roof = random.uniform(0.0, 1.5);
  const double wide = random.uniform(1.0, 1.4);
  return moved(lathe({{0, 0},
                      {radius, 0},
                      {radius, height},
                      {wide * radius, height},
                      {wide * radius, height + 0.2},
                      {0, height + 0.2 + roof}},
                     chance(random, 0.4) ? 4 : 16),
               foot);
}

}  // namespace

Mesh house(Random& random) {
  const Vec3 size{random.uniform(1.0, 2.0), 1.0, random.uniform(0.5, 1.3)};
  const double ridge = chance(random, 0.7) ? 1.0 : random.uniform(0.0, 0.8);
  Mesh mesh = roofed({0, 0, 0}, size, random.uniform(0.2, 1.0), ridge);
  if (chance(random, 0.6)) {  // a wing
    const Vec3 annexe{random.uniform(0.4, 1.0), random.uniform(0.5, 1.0), size.z() * random.uniform(0.5, 1.1)};
    const Vec3 place{random.uniform(-0.6, 0.6) * size.x(), random.uniform(0.4, 0.8), 0};
    add(mesh, moved(turned(roofed({0, 0, 0}, annexe, random.uniform(0.2, 0.6), 1.0), 0.25, Vec3::UnitZ()), place));
  }
  if (chance(random, 0.7)) {
    const double x = random.uniform(-0.4, 0.4) * size.x();
    add(mesh, box({x, 0.2, size.z() + 0.4}, {0.15, 0.15, 1.0}));
  }
  if (chance(random, 0.4)) {  // a church
    const double radius = random.uniform(0.25, 0.45);
    const double height = size.z() + random.uniform(0.5, 2.0);
    add(mesh, tower(random, {-0.5 * size.x(), 0, 0}, radius, height));
  }
  if (chance(random, 0.4)) {
    add(mesh, box({0, 0, 0}, {1.8 * size.x(), 2.2, 0.05}));
  }
  return mesh;
}

Mesh castle(Random& random) {
  const int corners = whole(random, 3, 6);
  const double wall = random.uniform(0.4, 0.9);
  const double radius = random.uniform(0.15, 0.3);
  const Vec2 next = on_circle(1.0 / corners);
  const Vec3 middle(0.5 * (1.0 + next.x()), 0.5 * next.y(), 0.5 * wall);
  const double length = std::hypot(next.x() - 1.0, next.y());
  Mesh side = moved(turned(box({0, 0, 0}, {0.12, length, wall}), 0.5 / corners, Vec3::UnitZ()), middle);
  const double high = wall + random.uniform(0.1, 0.8);
  add(side, tower(random, {1, 0, 0}, radius, high));
  Mesh mesh = around(side, corners);
  for (int k = whole(random, 1, 3); k > 0; --k) {
    const Vec3 place = vector(random, -0.4, 0.4).cwiseProduct(Vec3{1, 1, 0});
    const double thick = random.uniform(0.15, 0.4);
    const double keep = random.uniform(0.8, 2.0);
    add(mesh, tower(random, place, thick, keep));
  }
  return mesh;
}

Mesh temple(Random& random) {
  const int columns = whole(random, 3, 7);
  const double length = random.uniform(1.0, 3.0);
  const double height = random.uniform(0.6, 1.5);
  const double radius = random.uniform(0.05, 0.12);
  Mesh mesh = roofed({0, 0, height}, {length + 0.3, 1.3, 0.15}, random.uniform(0.2, 0.6), 1.0);
  for (int k = 0; k < columns; ++k) {
    const double x = length * (k / (columns - 1.0) - 0.5);
    add(mesh, column({x, -0.5, 0}, height, radius));
    add(mesh, column({x, 0.5, 0}, height, radius));
  }
  const int steps = whole(random, 1, 4);
  for (int k = 0; k < steps; ++k) {
    const double grow = 0.4 + 0.15 * k;
    add(mesh, box({0, 0, -0.05 - 0.1 * k}, {length + grow, 1.2 + grow, 0.1}));
  }
  if (chance(random, 0.5)) {
    add(mesh, box({0, 0, 0.5 * height}, {0.75 * length, 0.6, height}));
  }
  return mesh;
}

Mesh dome(Random& random) {
  const double drum = random.uniform(0.1, 1.0);
  const double height = random.uniform(0.5, 1.5);
  Mesh mesh = moved(stretched(globe([](const Vec3&) { return 1.0; }), {0.9, 0.9, height}), Vec3{0, 0, drum});
  add(mesh, lathe({{0, 0}, {1, 0}, {1, drum}, {0.9, drum}}, whole(random, 8, 24)));
  add(mesh, rod({0, 0, drum + height - 0.1}, {0, 0, drum + height + random.uniform(0.2, 0.7)}, 0.15, 0.02));
  if (chance(random, 0.6)) {
    add(mesh, box({0, 0, 0}, {random.uniform(1.5, 3.5), random.uniform(1.5, 2.5), random.uniform(0.3, 1.0)}));
  }
  if (chance(random, 0.5)) {
    const double far = random.uniform(1.2, 1.8);
    const double radius = random.uniform(0.1, 0.2);
    const double high = random.uniform(1.0, 2.5);
    const Mesh minaret = tower(random, {far, 0, 0}, radius, high);
    add(mesh, around(minaret, whole(random, 2, 4)));
  }
  return mesh;
}

Mesh town(Random& random) {
  const int streets = whole(random, 2, 5);
  const double tall = random.uniform(0.5, 3.0);
  Mesh mesh = box({0, 0, -0.05}, {streets + 0.4, streets + 0.4, 0.1});
  for (int r = 0; r < streets; ++r) {
    for (int c = 0; c < streets; ++c) {
      const Vec3 size{random.uniform(0.3, 0.9), random.uniform(0.3, 0.9), tall * random.uniform(0.2, 1.0)};
      const Vec3 place(c - 0.5 * (streets - 1), r - 0.5 * (streets - 1), 0);
      add(mesh, chance(random, 0.3) ? tower(random, place, 0.4 * size.x(), size.z())
                                    : roofed(place, size, random.uniform(0.0, 0.4), 1.0));
    }
  }
  return mesh;
}

Mesh bridge(Random& random) {
  const int arches = whole(random, 1, 5);
  const double wide = random.uniform(0.2, 0.7);
  const double thick = random.uniform(0.05, 0.15);
  const double rise = random.uniform(0.2, 0.9);
  const bool hanging = chance(random, 0.4);
  Mesh mesh = box({0.5 * arches, 0, rise + 0.5 * thick}, {arches + 0.3, wide, thick});
  for (int k = 0; k < arches; ++k) {
    std::vector<Vec3> arch;
    for (int s = 0; s <= 12; ++s) {
      const double t = s / 12.0;
      const double bow = 4.0 * t * (1.0 - t);
      arch.emplace_back(k + t, 0.5 * wide, hanging ? rise + 0.8 * (1.0 - bow) : rise * bow);
    }
    Mesh side = tube(arch, 0.6 * thick, 6);
    add(side, rod({1.0 * k, 0.5 * wide, -0.1}, {1.0 * k, 0.5 * wide, hanging ? rise + 0.8 : rise}, thick));
    for (int s = 2; s < 12; s += 2) {
      const Vec3& at = arch[static_cast<std::size_t>(s)];
      add(side, rod(at, {at.x(), at.y(), rise + 0.01}, 0.15 * thick));
    }
    add(mesh, side);
    add(mesh, stretched(side, {1, -1, 1}));
  }
  return mesh;
}

// Straight or spiral stairs, or a ladder.
Mesh stairs(Random& random) {
  const int steps = whole(random, 4, 14);
  const double wide = random.uniform(0.4, 2.0);
  const double rise = random.uniform(0.12, 0.3);
  const double turn = chance(random, 0.5) ? random.uniform(0.02, 0.1) : 0.0;
  const bool solid = turn == 0.0 && chance(random, 0.6);
  Mesh mesh;
  for (int k = 0; k < steps; ++k) {
    const double high = rise * (k + 1);
    if (turn > 0.0) {
      add(mesh, turned(box({0.5 * wide, 0, high}, {wide, 0.3, 0.06}), turn * k, Vec3::UnitZ()));
    } else {
      add(mesh, box({0, 0.25 * k, solid ? 0.5 * high : high}, {wide, 0.26, solid ? high : 0.06}));
    }
  }
  if (turn > 0.0) {
    add(mesh, rod({0, 0, 0}, {0, 0, rise * steps + 0.5}, 0.08));
  } else if (chance(random, 0.6)) {
    add(mesh, mirrored(rod({0.5 * wide, 0, rise}, {0.5 * wide, 0.25 * steps, rise * (steps + 1)}, 0.05)));
  }
  return mesh;
}

// Lamps, signs and letter boxes: a post that carries things.
Mesh lantern(Random& random) {
  const double height = random.uniform(1.0, 3.5);
  Mesh mesh = rod({0, 0, 0}, {0, 0, height}, random.uniform(0.03, 0.12), 0.04);
  const double foot = random.uniform(0.15, 0.6);
  add(mesh, lathe({{0, 0}, {foot, 0}, {foot, 0.05}, {0.1, 0.15}}));
  const double reach = random.uniform(0.0, 1.0);
  const int arms = reach < 0.3 ? 1 : whole(random, 1, 4);
  const double drop = random.uniform(-0.3, 0.3);
  Mesh arm = tube(
      smooth({{0, 0, height - 0.1}, {0.5 * reach + 0.02, 0, height + 0.2}, {reach + 0.04, 0, height + drop}}), 0.03, 6);
  const Vec3 size = vector(random, 0.15, 0.5);
  Mesh lamp = ellipsoid({0, 0, 0}, size);
  switch (whole(random, 0, 3)) {
    case 0:
      lamp = lathe({{size.x(), -size.z()}, {0.4 * size.y(), size.z()}, {0.02, size.z()}}, whole(random, 4, 20));
      break;
    case 1:
      lamp = box({0, 0, 0}, 2.0 * size);
      break;
    case 2:
      lamp = turned(plate({{1, 0}, {0.5, 0.87}, {-0.5, 0.87}, {-1, 0}, {-0.5, -0.87}, {0.5, -0.87}}, 0.1), 0.25,
                    Vec3::UnitX());
      lamp = stretched(lamp, {size.x(), 0.3, size.z()});
      break;
    default:
      break;
  }
  add(arm, moved(lamp, Vec3{reach + 0.04, 0, height + drop}));
  add(mesh, around(arm, arms));
  return mesh;
}

}  // namespace spincat::background
