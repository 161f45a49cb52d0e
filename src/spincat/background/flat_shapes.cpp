// Plates, bars, and the things that are made of them.
#include <algorithm>
#include <cmath>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

// An outline around the origin: a circle with `folds` waves of random height, random ones where folds is 0.
std::vector<Vec2> wavy_outline(Random& random, int folds) {
  std::vector<Vec2> waves;
  for (int k = 0; k < 4; ++k) {
    const double height = random.uniform(0.0, 0.5) / (1.0 + k);
    waves.push_back(on_circle(random.uniform()) * height);
  }
  std::vector<Vec2> outline;
  for (int k = 0; k < 64; ++k) {
    const double t = k / 64.0;
    double r = 1.0;
    for (int w = 0; w < 4; ++w) {
      r += waves[static_cast<std::size_t>(w)].dot(on_circle((folds == 0 ? w + 1 : folds * (w + 1)) * t));
    }
    outline.push_back(on_circle(t) * std::max(r, 0.1));
  }
  return outline;
}

// A thin plate of any outline, with or without a hole, that begins near the origin and lies along x.
Mesh paddle(Random& random, const Vec3& size) {
  const std::vector<Vec2> outline = wavy_outline(random, 0);
  const double hole = random.uniform(0.0, 0.7);
  return moved(stretched(plate(outline, 0.1, hole), size), Vec3{size.x(), 0, 0});
}

// A slab between two points of the plane z = 0.
Mesh stroke(const Vec2& from, const Vec2& to, double width, double thickness) {
  const Vec2 along = to - from;
  const Mesh slab = box({0, 0, 0}, {along.norm() + width, width, thickness});
  const double turns = std::atan2(along.y(), along.x()) / (8.0 * std::atan(1.0));
  const Vec2 middle = 0.5 * (from + to);
  return moved(turned(slab, turns, Vec3::UnitZ()), Vec3{middle.x(), middle.y(), 0});
}

}  // namespace

Mesh gear(Random& random) {
  const int teeth = whole(random, 3, 24);
  const double depth = random.uniform(0.5, 0.95);
  const bool pointed = chance(random, 0.3);
  std::vector<Vec2> outline;
  for (int k = 0; k < 4 * teeth; ++k) {
    const bool outside = pointed ? k % 4 == 1 : k % 4 < 2;
    outline.push_back(on_circle(k / (4.0 * teeth)) * (outside ? 1.0 : depth));
  }
  const double thickness = random.uniform(0.05, 0.8);
  Mesh mesh = plate(outline, thickness, random.uniform(0.0, 0.8) * depth);
  if (chance(random, 0.4)) {
    add(mesh, rod({0, 0, -random.uniform(0.1, 1.0)}, {0, 0, 0.6}, 0.2));
  }
  return mesh;
}

Mesh random_plate(Random& random) {
  const int folds = chance(random, 0.5) ? 0 : whole(random, 2, 6);
  const std::vector<Vec2> outline = wavy_outline(random, folds);
  const double thickness = random.uniform(0.03, 1.5);
  const double hole = chance(random, 0.4) ? random.uniform(0.2, 0.85) : 0.0;
  return stretched(plate(outline, thickness, hole), {1.0, random.uniform(0.4, 1.0), 1.0});
}

// Strokes on a grid of 3 x 4 places: letters, brackets, pipes of a square section where it is deep.
Mesh letter(Random& random) {
  const double width = random.uniform(0.15, 0.6);
  const double depth = chance(random, 0.3) ? random.uniform(1.0, 5.0) : random.uniform(0.1, 0.8);
  Vec2 at(whole(random, 0, 2), 0);
  Mesh mesh;
  for (int k = whole(random, 2, 6); k > 0; --k) {
    Vec2 next = at;
    while (next == at) {
      const double x = whole(random, 0, 2);
      const double y = whole(random, 0, 3);
      next = chance(random, 0.5) ? Vec2(x, at.y()) : Vec2(chance(random, 0.3) ? x : at.x(), y);
    }
    add(mesh, stroke(at, next, width, depth));
    at = next;
  }
  return mesh;
}

// A perforated plate, a fence or a net.
Mesh grating(Random& random) {
  const int columns = whole(random, 3, 10);
  const int rows = whole(random, 1, 7);
  const double bar = random.uniform(0.04, 0.2);
  const double depth = random.uniform(0.5, 2.0) * bar;
  Mesh mesh;
  for (int c = 0; c <= columns; ++c) {
    add(mesh, box({c - 0.5 * columns, 0, 0}, {bar, rows + random.uniform(0.0, 0.8), depth}));
  }
  for (int r = 0; r <= rows; ++r) {
    add(mesh, box({0, r - 0.5 * rows, 0.2 * depth}, {columns + bar, bar, depth}));
  }
  const double arch = random.uniform(0.0, 0.08);
  for (Vec3& v : mesh.vertices) {
    v.z() += arch * v.x() * v.x();
  }
  return mesh;
}

Mesh blade(Random& random) {
  const double length = random.uniform(1.5, 6.0);
  const double width = random.uniform(0.15, 0.6);
  const double curve = random.uniform(0.0, 0.08);
  const double edge = random.uniform(0.2, 0.9);
  Mesh mesh = surface(12, 4, [&](double u, double v) {
    const double x = length * u;
    const double half = width * (1.0 - std::pow(u, 4.0));
    const Vec2 around = on_circle(v);
    return Vec3(x, half * around.x() + curve * x * x, 0.12 * edge * half * around.y());
  });
  const double guard = random.uniform(0.0, 0.8);
  add(mesh, box({0, 0, 0}, {0.12, width + guard, 0.15}));
  const double grip = random.uniform(0.6, 2.0);
  add(mesh, rod({0, 0, 0}, {-grip, 0, 0}, 0.1, random.uniform(0.08, 0.2)));
  add(mesh, ellipsoid({-grip, 0, 0}, vector(random, 0.1, 0.25)));
  return mesh;
}

// A handle with something at its end: hammers, axes, spades, spanners, screwdrivers, brushes.
Mesh hand_tool(Random& random) {
  const double length = random.uniform(1.5, 5.0);
  const double end = random.uniform(0.04, 0.15);
  Mesh mesh = rod({-length, 0, 0}, {0, 0, 0}, random.uniform(0.06, 0.2), end);
  const Vec3 size = vector(random, 0.15, 1.2);
  switch (whole(random, 0, 4)) {
    case 0:
      add(mesh, box({0, 0.3 * random.uniform(-1.0, 1.0) * size.y(), 0}, {0.5 * size.x(), size.y(), 0.4 * size.z()}));
      break;
    case 1:
      add(mesh, ellipsoid({0.8 * size.x(), 0, 0}, {size.x(), 0.6 * size.y(), 0.2 * size.z()}));
      break;
    case 2:
      add(mesh, paddle(random, size));
      break;
    case 3: {
      const double spread = random.uniform(0.1, 0.5);
      for (int k = -2; k <= 2; ++k) {
        add(mesh, rod({0, 0, 0}, {size.x(), spread * k, 0}, 0.05));
      }
      break;
    }
    default:
      add(mesh, rod({0, 0, 0}, {size.x(), 0, 0}, 0.5 * size.y(), 0.5 * size.z()));
  }
  return mesh;
}

Mesh gun(Random& random) {
  const double barrel = random.uniform(1.0, 4.0);
  const double deep = random.uniform(0.1, 0.3);
  Mesh mesh = rod({0, 0, 0}, {barrel, 0, 0}, random.uniform(0.05, 0.15));
  const double body = random.uniform(0.5, 1.5);
  add(mesh, box({0, -0.05, 0}, {body, random.uniform(0.25, 0.5), deep}));
  const double lean = random.uniform(0.02, 0.1);
  add(mesh, turned(box({-0.35 * body, -0.6, 0}, {0.35, random.uniform(0.6, 1.1), deep}), -lean, Vec3::UnitZ()));
  add(mesh, moved(ring(0.15, 0.03), Vec3{0, -0.35, 0}));
  if (chance(random, 0.5)) {  // a stock
    add(mesh, turned(box({-1.2, -0.2, 0}, {1.6, random.uniform(0.25, 0.5), deep}), 0.02, Vec3::UnitZ()));
  }
  if (chance(random, 0.4)) {
    add(mesh, rod({-0.4, 0.35, 0}, {0.5, 0.35, 0}, 0.09));
  }
  return mesh;
}

Mesh guitar(Random& random) {
  const std::vector<Vec2> outline = wavy_outline(random, 2);
  const double deep = random.uniform(0.2, 0.6);
  Mesh mesh = stretched(plate(outline, deep), {1.0, random.uniform(0.5, 0.9), 1.0});
  const double neck = random.uniform(1.8, 3.2);
  add(mesh, box({0.5 + 0.5 * neck, 0, 0.15}, {neck, random.uniform(0.12, 0.3), 0.12}));
  add(mesh, box({0.6 + neck, 0, 0.15}, {0.5, random.uniform(0.25, 0.5), 0.1}));
  if (chance(random, 0.5)) {
    add(mesh, box({-0.3, 0, 0.3}, {0.12, 0.5, 0.1}));
  }
  return mesh;
}

// A slab on a foot, on two posts, or hinged to another slab.
Mesh screen(Random& random) {
  const double wide = random.uniform(0.8, 2.0);
  const double thick = random.uniform(0.04, 0.5);
  Mesh mesh = box({0, 0, 0}, {wide, thick, 1.0});
  switch (whole(random, 0, 2)) {
    case 0:
      add(mesh, rod({0, 0, -0.4}, {0, 0, -0.8}, 0.1));
      add(mesh, moved(lathe({{0, 0}, {random.uniform(0.25, 0.6), 0}, {0.1, 0.12}}), Vec3{0, 0, -0.85}));
      break;
    case 1: {
      const double post = random.uniform(0.8, 2.5);
      add(mesh, mirrored(rod({0.35 * wide, 0, -0.4}, {0.35 * wide, 0, -post}, 0.05)));
      break;
    }
    default: {
      const double tilt = random.uniform(0.15, 0.45);
      add(mesh, moved(turned(box({0, 0, 0.5}, {wide, thick, 1.0}), tilt, Vec3::UnitX()), Vec3{0, 0, -0.5}));
    }
  }
  return mesh;
}

Mesh spectacles(Random& random) {
  const double wide = random.uniform(0.5, 0.9);
  Mesh lens = moved(stretched(ring(0.5, random.uniform(0.03, 0.1)), {1.0, wide, 1.0}), Vec3{0.65, 0, 0});
  if (chance(random, 0.5)) {
    add(lens, moved(ellipsoid({0, 0, 0}, {0.5, 0.5 * wide, 0.05}), Vec3{0.65, 0, 0}));
  }
  const double back = random.uniform(0.8, 1.6);
  add(lens, tube(smooth({{1.15, 0, 0}, {1.15, 0, -back}, {1.1, -0.3, -back - 0.3}}), 0.04));
  add(lens, rod({0, 0.1, 0}, {0.2, 0.1, 0}, 0.04));
  return mirrored(lens);
}

// A truss: the edges of a row of cubes, and diagonals.
Mesh lattice(Random& random) {
  const int cells = whole(random, 2, 7);
  const double bar = random.uniform(0.02, 0.09);
  const double taper = random.uniform(0.0, 0.12);
  const int sides = whole(random, 3, 4);
  Mesh mesh;
  for (int c = 0; c < cells; ++c) {
    const double low = 0.6 * (1.0 - taper * c);
    const double high = 0.6 * (1.0 - taper * (c + 1));
    const Vec2 next = on_circle(1.0 / sides);
    Mesh side = rod({low, 0, 1.0 * c}, {high, 0, c + 1.0}, bar);
    add(side, rod({low, 0, 1.0 * c}, {low * next.x(), low * next.y(), 1.0 * c}, bar));
    add(side, rod({low, 0, 1.0 * c}, {high * next.x(), high * next.y(), c + 1.0}, 0.7 * bar));
    add(mesh, around(side, sides));
  }
  return mesh;
}

}  // namespace spincat::background
