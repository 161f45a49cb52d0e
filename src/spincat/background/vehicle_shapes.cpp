// What drives, flies and swims: forwards is x, up is z.
#include <algorithm>
#include <cmath>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

// A disk that stands along x, for wheels, with its axle along y.
Mesh disk(const Vec3& centre, double radius, double width) {
  const double half = 0.5 * width;
  return moved(turned(lathe({{0, -half}, {radius, -half}, {radius, half}, {0, half}}, 16), 0.25, Vec3::UnitX()),
               centre);
}

Mesh wheels(double front, double back, double track, double radius, double z) {
  Mesh mesh;
  for (const double x : {front, back}) {
    for (const double y : {-track, track}) {
      add(mesh, disk({x, y, z}, radius, 0.6 * radius));
    }
  }
  return mesh;
}

// A body along x whose half width and height change as the sections say: (x, half width, low, high), rounded by
// `corner` (1: an ellipse; towards 0: a box).
Mesh hull(const std::vector<Eigen::Vector4d>& sections, double corner) {
  const double last = static_cast<double>(sections.size() - 1);
  const auto bent = [corner](double x) { return std::copysign(std::pow(std::abs(x), corner), x); };
  return surface(static_cast<int>(last), 16, [&](double u, double v) {
    const Eigen::Vector4d& s = sections[static_cast<std::size_t>(std::lround(u * last))];
    const Vec2 around = on_circle(v);
    return Vec3(s[0], s[1] * bent(around.x()), 0.5 * (s[2] + s[3]) + 0.5 * (s[3] - s[2]) * bent(around.y()));
  });
}

// A wing to one side, at y = 0 as long as `chord`, swept back, and a little higher at its tip.
Mesh wing(double span, double chord, double tip, double sweep, double lift) {
  return surface(4, 8, [&](double u, double v) {
    const Vec2 around = on_circle(v);
    const double half = 0.5 * (chord + (tip - chord) * u);
    return Vec3(half * around.x() - sweep * u, span * u, lift * u + 0.08 * half * around.y());
  });
}

Mesh both_sides(const Mesh& mesh) {
  Mesh all = mesh;
  add(all, stretched(mesh, {1, -1, 1}));
  return all;
}

Mesh propeller(Random& random, double radius) {
  const int blades = whole(random, 2, 5);
  const double wide = radius * random.uniform(0.06, 0.15);
  Mesh mesh = around(box({0.5 * radius, 0, 0}, {radius, wide, 0.02}), blades);
  add(mesh, ellipsoid({0, 0, 0}, Vec3::Constant(0.1 * radius)));
  return mesh;
}

}  // namespace

Mesh car(Random& random) {
  const double wide = random.uniform(0.3, 0.5);
  const double waist = random.uniform(0.15, 0.4);
  const double roof = waist + random.uniform(0.15, 0.5);
  const double nose = random.uniform(0.05, 0.35);
  const double corner = random.uniform(0.2, 0.6);
  Mesh mesh = hull({{-1.0, 0, 0, waist},
                    {-1.0, 0.9 * wide, 0, waist},
                    {0.3, wide, -0.02, waist},
                    {1.0, 0.9 * wide, 0, waist - 0.4 * nose},
                    {1.0 + nose, 0, 0, 0.1}},
                   corner);
  const double back = random.uniform(-0.95, -0.5);
  const double front = random.uniform(0.1, 0.6);
  add(mesh, hull({{back - 0.1, 0, 0.5 * waist, waist},
                  {back - 0.1, 0.9 * wide, 0.5 * waist, waist},
                  {back + 0.1, 0.8 * wide, 0.5 * waist, roof},
                  {front - 0.3, 0.8 * wide, 0.5 * waist, roof},
                  {front, 0.9 * wide, 0.5 * waist, waist},
                  {front, 0, 0.5 * waist, waist}},
                 0.4));
  const double radius = random.uniform(0.13, 0.3);
  add(mesh, wheels(random.uniform(0.5, 0.7), -0.6, 0.9 * wide, radius, 0.0));
  if (chance(random, 0.25)) {  // a spoiler
    add(mesh, box({-0.95, 0, roof}, {0.2, 1.8 * wide, 0.03}));
    add(mesh, both_sides(rod({-0.95, 0.6 * wide, 0}, {-0.95, 0.6 * wide, roof}, 0.03)));
  }
  return mesh;
}

// Lorries, trains and carts: a row of boxes and barrels on many wheels.
Mesh lorry(Random& random) {
  Mesh mesh;
  double x = 0.0;
  const double wide = random.uniform(0.3, 0.5);
  const double radius = random.uniform(0.12, 0.3);
  for (int k = whole(random, 2, 4); k > 0; --k) {
    const double length = random.uniform(0.4, 1.6);
    const double height = random.uniform(0.3, 1.1);
    if (chance(random, 0.3)) {
      add(mesh, rod({x, 0, 0.5 * height + radius}, {x + length, 0, 0.5 * height + radius}, 0.5 * height));
    } else {
      add(mesh, box({x + 0.5 * length, 0, 0.5 * height + radius}, {length, 2.0 * wide, height}));
    }
    add(mesh, box({x + 0.5 * length, 0, radius}, {length + 0.2, 0.8 * wide, 0.1}));
    add(mesh, wheels(x + 0.2 * length, x + 0.8 * length, wide, radius, 0.5 * radius));
    x += length + random.uniform(0.02, 0.2);
  }
  if (chance(random, 0.4)) {
    add(mesh, rod({x - 0.4, 0, 0.3}, {x - 0.4, 0, random.uniform(1.0, 1.8)}, 0.08));
  }
  return mesh;
}

Mesh tank(Random& random) {
  const double wide = random.uniform(0.4, 0.6);
  Mesh mesh =
      hull({{-1.0, 0, 0, 0.3}, {-1.0, wide, 0, 0.3}, {0.7, wide, 0, 0.35}, {1.1, wide, 0.1, 0.15}, {1.1, 0, 0.1, 0.15}},
           0.15);
  const double radius = random.uniform(0.15, 0.25);
  const int count = whole(random, 3, 6);
  for (int k = 0; k < count; ++k) {
    add(mesh, both_sides(disk({-0.85 + 1.7 * k / (count - 1), wide, 0}, radius, 0.25)));
  }
  add(mesh, both_sides(box({0, wide, radius}, {1.9, 0.26, 0.05})));
  const double turret = random.uniform(0.3, 0.5);
  const double at = random.uniform(-0.4, 0.2);
  const int corners = chance(random, 0.5) ? 6 : 20;
  const double shoulder = random.uniform(0.5, 0.7);
  add(mesh, moved(lathe({{turret, 0.3}, {0.8 * turret, shoulder}, {0, 0.7}}, corners), Vec3{at, 0, 0}));
  const double turns = random.uniform(-0.15, 0.15);
  const double barrel = random.uniform(0.8, 1.8);
  const Mesh gun = rod({0, 0, 0.5}, {barrel, 0, 0.5 + random.uniform(0.0, 0.3)}, 0.07, 0.05);
  add(mesh, moved(turned(gun, turns, Vec3::UnitZ()), Vec3{at, 0, 0}));
  return mesh;
}

Mesh bicycle(Random& random) {
  const double radius = random.uniform(0.35, 0.6);
  const double tyre = random.uniform(0.03, 0.15);
  const double bar = random.uniform(0.02, 0.08);
  const Mesh one = turned(ring(radius, tyre), 0.25, Vec3::UnitX());
  Mesh mesh;
  for (const double x : {-0.8, 0.8}) {
    add(mesh, moved(one, Vec3{x, 0, 0}));
    for (int k = 0; k < 4; ++k) {
      const Vec2 spoke = on_circle(k / 8.0) * radius;
      add(mesh, rod({x - spoke.x(), 0, -spoke.y()}, {x + spoke.x(), 0, spoke.y()}, 0.01));
    }
  }
  const Vec3 saddle(-0.35, 0, random.uniform(0.6, 0.9));
  const Vec3 steering(0.6, 0, random.uniform(0.6, 1.0));
  const Vec3 pedals(-0.1, 0, random.uniform(-0.2, 0.1));
  const Vec3 hub(-0.8, 0, 0);
  for (const auto& [from, to] : std::vector<std::pair<Vec3, Vec3>>{{hub, saddle},
                                                                   {hub, pedals},
                                                                   {pedals, saddle},
                                                                   {saddle, steering},
                                                                   {pedals, steering},
                                                                   {{0.8, 0, 0}, steering}}) {
    add(mesh, rod(from, to, bar));
  }
  add(mesh, ellipsoid(saddle, {0.2, 0.1, 0.06}));
  add(mesh, tube(smooth({steering + Vec3{-0.15, -0.35, 0.1}, steering, steering + Vec3{-0.15, 0.35, 0.1}}), bar));
  if (chance(random, 0.4)) {  // a motorcycle
    add(mesh, ellipsoid({0.1, 0, 0.35}, vector(random, 0.15, 0.4)));
    add(mesh, box({0.0, 0, 0.05}, vector(random, 0.2, 0.4)));
  }
  return mesh;
}

Mesh ship(Random& random) {
  const double wide = random.uniform(0.12, 0.35);
  const double deep = random.uniform(0.1, 0.35);
  const double bow = random.uniform(1.0, 1.6);
  Mesh mesh = hull({{-1.2, 0, 0, 0.1},
                    {-1.2, 0.8 * wide, -deep, 0.1},
                    {-0.3, wide, -deep, 0.05},
                    {0.6, 0.8 * wide, -deep, 0.1},
                    {bow, 0.02, 0.0, random.uniform(0.1, 0.3)}},
                   0.5);
  for (int k = whole(random, 1, 5); k > 0; --k) {
    const Vec3 size = vector(random, 0.1, 0.6);
    const double x = random.uniform(-0.9, 0.6);
    add(mesh, box({x, 0, 0.25 * size.z()}, {size.x(), std::min(size.y(), 1.6 * wide), 0.6 * size.z()}));
  }
  for (int k = whole(random, 0, 3); k > 0; --k) {
    const double x = random.uniform(-0.8, 0.6);
    const double high = random.uniform(0.4, 1.0);
    add(mesh, rod({x, 0, 0}, {x - 0.05, 0, high}, random.uniform(0.02, 0.1)));
  }
  return mesh;
}

Mesh sailing_boat(Random& random) {
  const double wide = random.uniform(0.1, 0.35);
  Mesh mesh = hull({{-1.0, 0.5 * wide, -0.1, 0.1},
                    {0.0, wide, -random.uniform(0.15, 0.4), 0.05},
                    {0.7, 0.5 * wide, -0.1, 0.1},
                    {1.2, 0.01, 0.1, 0.2}},
                   0.8);
  const int masts = whole(random, 1, 3);
  for (int k = 0; k < masts; ++k) {
    const double x = masts == 1 ? 0.2 : -0.6 + 1.2 * k / (masts - 1);
    const double height = random.uniform(0.9, 2.4);
    const double foot = random.uniform(0.4, 0.9);
    const double top = chance(random, 0.5) ? 0.0 : random.uniform(0.3, 0.8);
    const double belly = random.uniform(0.0, 0.3);
    add(mesh, rod({x, 0, 0}, {x, 0, height + 0.1}, 0.03));
    add(mesh, surface(6, 6, [&](double u, double v) {
          const double length = foot + (top * foot - foot) * u;
          return Vec3(x - length * v, belly * std::sin(3.14 * v) * (1.0 - 0.5 * u), 0.2 + (height - 0.2) * u);
        }));
  }
  if (chance(random, 0.4)) {
    add(mesh, rod({0.9, 0, 0.1}, {1.7, 0, 0.35}, 0.03));
  }
  return mesh;
}

Mesh aeroplane(Random& random) {
  const double thick = random.uniform(0.06, 0.2);
  Mesh mesh = hull({{-1.2, 0.02, 0, 0.1},
                    {-0.6, 0.6 * thick, -thick, thick},
                    {0.3, thick, -thick, thick},
                    {0.8, 0.8 * thick, -thick, 0.8 * thick},
                    {1.1, 0.02, -0.05, 0.02}},
                   1.0);
  const double span = random.uniform(0.6, 2.0);
  const double chord = random.uniform(0.25, 1.0);
  const double tip = chord * random.uniform(0.05, 1.0);
  const double sweep = random.uniform(-0.3, 0.9);
  const Mesh half = wing(span, chord, tip, sweep, random.uniform(-0.1, 0.3));
  const double z = chance(random, 0.5) ? -0.5 * thick : thick;
  add(mesh, both_sides(moved(half, Vec3{0.1, 0, z})));
  if (chance(random, 0.25)) {  // a biplane
    add(mesh, both_sides(moved(half, Vec3{0.1, 0, z + random.uniform(0.3, 0.5)})));
    add(mesh, both_sides(rod({0.1, 0.6 * span, z}, {0.1, 0.6 * span, z + 0.4}, 0.02)));
  }
  const double tail_span = random.uniform(0.2, 0.6);
  const Mesh tail = wing(tail_span, 0.3, 0.15, random.uniform(0.0, 0.4), 0.0);
  add(mesh, both_sides(moved(tail, Vec3{-1.0, 0, 0.1})));
  const double lean = random.uniform(0.0, 0.1);
  if (chance(random, 0.3)) {
    add(mesh, both_sides(moved(turned(tail, 0.25 - lean, Vec3::UnitX()), Vec3{-0.9, 0.1, 0})));
  } else {
    add(mesh, moved(turned(tail, 0.25, Vec3::UnitX()), Vec3{-1.0, 0, 0}));
  }
  for (int k = whole(random, 0, 2); k > 0; --k) {
    const double y = 0.35 * span * k;
    add(mesh, both_sides(rod({0.0, y, z - 0.06}, {0.4, y, z - 0.06}, 0.06)));
  }
  if (chance(random, 0.3)) {
    add(mesh, moved(turned(propeller(random, 0.4), 0.25, Vec3::UnitY()), Vec3{1.1, 0, 0}));
  }
  return mesh;
}

Mesh helicopter(Random& random) {
  const double thick = random.uniform(0.2, 0.4);
  Mesh mesh = ellipsoid({0, 0, 0}, {random.uniform(0.4, 0.9), thick, thick});
  const double boom = random.uniform(0.9, 1.8);
  add(mesh, rod({0, 0, 0.1}, {-boom, 0, 0.2}, 0.15, 0.05));
  add(mesh, rod({0, 0, 0}, {0, 0, thick + 0.15}, 0.05));
  add(mesh, moved(propeller(random, random.uniform(0.8, 1.6)), Vec3{0, 0, thick + 0.15}));
  add(mesh, moved(turned(propeller(random, 0.3), 0.25, Vec3::UnitX()), Vec3{-boom, 0.06, 0.25}));
  add(mesh, box({-boom, 0, 0.3}, {0.2, 0.03, 0.4}));
  add(mesh, both_sides(rod({-0.4, 0.3, -thick - 0.15}, {0.5, 0.3, -thick - 0.15}, 0.03)));
  add(mesh, both_sides(rod({0, 0, 0}, {0.1, 0.3, -thick - 0.15}, 0.03)));
  return mesh;
}

// Disks, pods and panels on arms.
Mesh spaceship(Random& random) {
  Mesh mesh;
  const double size = random.uniform(0.3, 1.0);
  add(mesh, ellipsoid({0.6, 0, 0.2}, {size, chance(random, 0.5) ? size : 0.4 * size, random.uniform(0.08, 0.4)}));
  add(mesh, rod({0.5, 0, 0}, {-random.uniform(0.3, 1.0), 0, -0.1}, 0.12, 0.15));
  for (int k = whole(random, 1, 2); k > 0; --k) {
    const double y = random.uniform(0.3, 1.0);
    const double z = random.uniform(-0.4, 0.5);
    const double length = random.uniform(0.4, 1.4);
    add(mesh, both_sides(rod({0, 0, 0}, {-0.3, y, z}, 0.05)));
    switch (whole(random, 0, 2)) {
      case 0:
        add(mesh, both_sides(rod({-0.3 - length, y, z}, {0.2, y, z}, 0.1)));
        break;
      case 1:
        add(mesh, both_sides(box({-0.3, y, z}, {length, random.uniform(0.03, 0.9), 0.04})));
        break;
      default:
        add(mesh, both_sides(box({-0.3, y, z}, {length, 0.04, random.uniform(0.4, 1.4)})));
    }
  }
  return mesh;
}

// Rockets, bombs, submarines, airships: a slim body with fins around its end.
Mesh rocket(Random& random) {
  const double thick = random.uniform(0.15, 0.5);
  const double blunt = random.uniform(0.3, 1.0);
  const double tail = random.uniform(0.1, 0.8);
  std::vector<Vec2> profile = {{0, -1.2}, {tail * thick, -1.2}};
  for (int k = 0; k <= 8; ++k) {
    const double t = k / 8.0;
    profile.emplace_back(
        thick * (tail + (1.0 - tail) * std::sin(1.57 * std::min(1.0, 2.0 * t))) * std::pow(1.0 - t, blunt * t),
        -1.0 + 2.2 * t);
  }
  profile.back().x() = 0.0;
  Mesh mesh = lathe(profile);
  const double span = random.uniform(0.2, 0.7);
  const double chord = random.uniform(0.2, 0.7);
  const Mesh fin = box({0.5 * (thick + span), 0, -1.0 + 0.5 * chord - 0.2}, {thick + span, 0.03, chord});
  add(mesh, around(fin, whole(random, 3, 5)));
  if (chance(random, 0.3)) {  // a tower or a gondola
    add(mesh, box({thick, 0, 0.1}, {0.3, 0.12, random.uniform(0.2, 0.6)}));
  }
  if (chance(random, 0.3)) {
    const double booster = random.uniform(0.08, 0.2);
    const Mesh one = rod({thick + booster, 0, -1.2}, {thick + booster, 0, 0.2}, booster, 0.5 * booster);
    add(mesh, around(one, whole(random, 2, 4)));
  }
  return mesh;
}

}  // namespace spincat::background
