// Bodies of revolution: vessels, turned parts, wheels, hats.
#include <cmath>
#include <numbers>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

// A smooth profile through `count` random radii, from the height 0 to `height`.
std::vector<Vec2> smooth_profile(Random& random, int count, double height) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    points.emplace_back(random.uniform(0.15, 1.0), 0.0, height * k / (count - 1));
  }
  std::vector<Vec2> profile;
  for (const Vec3& p : smooth(points)) {
    profile.emplace_back(std::abs(p.x()), p.z());
  }
  return profile;
}

// Closes a profile that goes up: by a bottom, and by an inner wall down to a floor.
std::vector<Vec2> hollow(std::vector<Vec2> outer, double wall) {
  const std::vector<Vec2> up = outer;
  outer.insert(outer.begin(), {0.0, up.front().y()});
  for (auto p = up.rbegin(); p + 1 != up.rend(); ++p) {
    outer.emplace_back(p->x() * (1.0 - wall), p->y());
  }
  outer.emplace_back(0.0, up[1].y());
  return outer;
}

std::vector<Vec2> filled(std::vector<Vec2> outer) {
  outer.insert(outer.begin(), {0.0, outer.front().y()});
  outer.emplace_back(0.0, outer.back().y());
  return outer;
}

// The upper half of a ball, flattened to `height`, at z = `base`.
std::vector<Vec2> cap(double radius, double height, double base) {
  std::vector<Vec2> profile;
  for (int k = 0; k <= 8; ++k) {
    const Vec2 at = on_circle(0.25 * k / 8.0);
    profile.emplace_back(radius * std::abs(at.x()), base + height * at.y());
  }
  return profile;
}

}  // namespace

Mesh vase(Random& random) {
  const int count = whole(random, 3, 6);
  const std::vector<Vec2> profile = smooth_profile(random, count, random.uniform(0.8, 4.0));
  return lathe(hollow(profile, random.uniform(0.05, 0.2)));
}

Mesh turned_part(Random& random) {
  std::vector<Vec2> profile;
  double height = 0.0;
  for (int k = whole(random, 2, 9); k > 0; --k) {
    const double radius = random.uniform(0.1, 1.0);
    profile.emplace_back(radius, height);
    height += random.uniform(0.05, 1.0);
    profile.emplace_back(chance(random, 0.3) ? random.uniform(0.1, 1.0) : radius, height);
  }
  return lathe(filled(profile), chance(random, 0.3) ? whole(random, 3, 8) : 24);
}

Mesh bottle(Random& random) {
  const double body = random.uniform(0.8, 3.0);
  const double neck = random.uniform(0.15, 0.5);
  const double shoulder = body + random.uniform(0.05, 1.0);
  const double top = shoulder + random.uniform(0.2, 1.2);
  const std::vector<Vec2> profile = {
      {0.9, 0},         {1.0, 0.1},  {1.0, body},       {0.5 * (1.0 + neck), 0.6 * shoulder + 0.4 * body},
      {neck, shoulder}, {neck, top}, {1.3 * neck, top}, {1.3 * neck, top + 0.15}};
  return lathe(filled(profile), chance(random, 0.25) ? 4 : 24);
}

Mesh mug(Random& random) {
  const double height = random.uniform(1.0, 3.0);
  const double rim = random.uniform(0.7, 1.4);
  Mesh mesh = lathe(hollow({{1.0, 0.0}, {1.0, 0.1}, {0.5 + 0.5 * rim, 0.5 * height}, {rim, height}}, 0.1));
  const double reach = random.uniform(0.4, 1.0);
  const double low = height * random.uniform(0.1, 0.3);
  const double high = height * random.uniform(0.7, 0.95);
  const std::vector<Vec3> handle = smooth({{0.95, 0, low}, {1 + reach, 0, low}, {1 + reach, 0, high}, {0.95, 0, high}});
  add(mesh, tube(handle, random.uniform(0.07, 0.18)));
  if (chance(random, 0.4)) {  // a jug
    add(mesh, tube(smooth({{-0.9, 0, 0.4 * height}, {-1.4, 0, 0.6 * height}, {-1.8, 0, height}}), 0.15));
  }
  return mesh;
}

Mesh goblet(Random& random) {
  const double stem = random.uniform(0.06, 0.2);
  const double base = random.uniform(0.6, 2.5);
  const double foot = random.uniform(0.5, 1.1);
  std::vector<Vec2> profile = {{foot, 0.0}, {foot, 0.06}, {stem, 0.2}, {stem, base}};
  const double height = random.uniform(0.6, 2.0);
  const double rim = random.uniform(0.5, 1.2);
  for (const double t : {0.15, 0.4, 0.7, 1.0}) {
    profile.emplace_back(stem + (rim - stem) * std::pow(t, 0.4), base + height * t);
  }
  profile.emplace_back(0.9 * rim, base + height);
  profile.emplace_back(0.0, base + 0.2 * height);
  return lathe(filled(profile));
}

Mesh wheel(Random& random) {
  const double tyre = random.uniform(0.08, 0.4);
  Mesh mesh = stretched(ring(1.0, tyre), {1, 1, random.uniform(0.6, 2.0)});
  const double hub = random.uniform(0.08, 0.35);
  add(mesh, lathe({{0, -0.15}, {hub, -0.15}, {hub, 0.15}, {0, 0.15}}));
  const int spokes = whole(random, 3, 14);
  const double width = random.uniform(0.02, 0.12);
  add(mesh, around(box({0.5, 0, 0}, {1.0, width, 0.5 * width + 0.03}), spokes));
  if (chance(random, 0.3)) {
    add(mesh, lathe({{0, -0.05}, {1, -0.05}, {1, 0.05}, {0, 0.05}}));
  }
  return mesh;
}

Mesh dish(Random& random) {
  const double depth = random.uniform(0.15, 1.1);
  const double bend = random.uniform(1.2, 4.0);
  std::vector<Vec2> profile;
  for (int k = 1; k <= 8; ++k) {
    const double r = k / 8.0;
    profile.emplace_back(r, depth * std::pow(r, bend));
  }
  Mesh mesh = lathe(hollow(profile, random.uniform(0.03, 0.1)));
  if (chance(random, 0.4)) {  // an aerial
    add(mesh, around(rod({0.95, 0, depth}, {0.05, 0, depth + 0.6}, 0.02), 3));
    add(mesh, rod({0, 0, 0}, {random.uniform(-0.4, 0.4), 0, -random.uniform(0.3, 1.2)}, 0.08, 0.15));
  }
  return mesh;
}

Mesh umbrella(Random& random) {
  const double height = random.uniform(0.2, 0.9);
  const double stem = random.uniform(1.0, 2.5);
  Mesh mesh = lathe(cap(1.0, height, stem), whole(random, 6, 16));
  add(mesh, rod({0, 0, 0}, {0, 0, stem + height + 0.1}, random.uniform(0.02, 0.08)));
  if (chance(random, 0.6)) {
    add(mesh, tube(smooth({{0, 0, 0}, {0.05, 0, -0.1}, {0.2, 0, -0.15}, {0.3, 0, 0}}), 0.05));
  }
  return mesh;
}

Mesh hat(Random& random) {
  const double crown = random.uniform(0.3, 1.5);
  const double brim = random.uniform(1.1, 2.2);
  const double lift = random.uniform(-0.3, 0.3);
  std::vector<Vec2> profile = {{0.9, 0.0}, {brim, lift - 0.03}, {brim, lift + 0.03}};
  const std::vector<Vec2> top = cap(1.0, crown, 0.05);
  profile.insert(profile.end(), top.begin(), top.end());
  Mesh mesh = stretched(lathe(profile), {1.0, random.uniform(1.0, 1.4), 1.0});
  if (chance(random, 0.4)) {  // a saucer: the same below
    add(mesh, stretched(lathe(cap(0.8, 1.0, 0.0)), {1.0, 1.0, -random.uniform(0.2, 0.8)}));
  }
  return mesh;
}

}  // namespace spincat::background
