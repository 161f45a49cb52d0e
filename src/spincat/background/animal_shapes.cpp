// Animals and people: ellipsoids and tubes on a skeleton. x is sideways, y forwards, z up.
#include <algorithm>
#include <cmath>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

// A limb of two bones that gets thinner.
Mesh limb(const Vec3& from, const Vec3& joint, const Vec3& to, double radius) {
  return tube({from, joint, to}, {radius, 0.75 * radius, 0.5 * radius});
}

// A flat fin or wing: from a line along y at x = 0 to a shorter one at x = span.
Mesh fin(double span, double chord, double tip_chord, double sweep) {
  const double thickness = 0.06 * chord;
  return surface(4, 8, [&](double u, double v) {
    const Vec2 around = on_circle(v);
    const double half = 0.5 * (chord + (tip_chord - chord) * u);
    return Vec3(span * u, half * around.x() - sweep * u, thickness * around.y() * (1.0 - 0.6 * u));
  });
}

}  // namespace

Mesh quadruped(Random& random) {
  const double thick = random.uniform(0.25, 0.6);
  const double leg = random.uniform(0.4, 1.3);
  Mesh mesh = ellipsoid({0, 0, 0}, {thick, 1.0, random.uniform(0.8, 1.2) * thick});
  const Vec3 shoulder(0, 0.85, 0.2);
  const double neck = random.uniform(0.1, 1.2);
  const Vec3 skull = shoulder + Vec3{0, neck * random.uniform(0.3, 1.0), neck * random.uniform(0.2, 1.0)};
  add(mesh, rod(shoulder, skull, 0.6 * thick, 0.4 * thick));
  const double snout = random.uniform(0.25, 0.5);
  add(mesh, ellipsoid(skull + Vec3{0, 0.5 * snout, 0}, {0.5 * snout, snout, 0.55 * snout}));
  const Vec3 ear{0.2, -0.1, random.uniform(0.2, 0.6)};
  add(mesh, mirrored(moved(rod({0.1, 0, 0.1}, ear, 0.08, 0.02), skull)));
  const double stride = random.uniform(-0.4, 0.4);
  const double foot = random.uniform(0.06, 0.16);
  for (const double end : {0.7, -0.7}) {
    const double step = end > 0 ? stride : -stride;
    add(mesh,
        limb({0.6 * thick, end, 0}, {0.7 * thick, end - 0.1, -0.5 * leg}, {0.7 * thick, end + step, -leg}, 2 * foot));
    add(mesh, limb({-0.6 * thick, end, 0}, {-0.7 * thick, end - 0.1, -0.5 * leg}, {-0.7 * thick, end - step, -leg},
                   2 * foot));
  }
  const double tail = random.uniform(0.2, 1.5);
  const double curl = random.uniform(-0.3, 0.3);
  const double end = random.uniform(-0.6, 0.6);
  add(mesh, tube(smooth({{0, -0.9, 0.1}, {0, -0.9 - 0.6 * tail, curl}, {0.1, -0.9 - tail, end}}), 0.07));
  return mesh;
}

Mesh person(Random& random) {
  const double wide = random.uniform(0.25, 0.5);
  Mesh mesh = ellipsoid({0, 0, 0.5}, {wide, 0.6 * wide, 0.6});
  add(mesh, ellipsoid({0, 0, 1.3}, {0.18, 0.2, random.uniform(0.2, 0.28)}));
  add(mesh, rod({0, 0, 1.0}, {0, 0, 1.3}, 0.1));
  for (const double side : {-1.0, 1.0}) {
    const Vec3 shoulder(0.85 * wide * side, 0, 0.85);
    const double lift = random.uniform(-1.0, 0.8);
    const Vec3 elbow =
        shoulder + 0.5 * Vec3{side * std::cos(lift), random.uniform(-0.3, 0.6), std::sin(lift)}.normalized();
    const Vec3 reach = vector(random, -0.5, 0.5);
    add(mesh, limb(shoulder, elbow, elbow + 0.5 * (reach + Vec3{0.5 * side, 0.2, -0.3}).normalized(), 0.11));
    const double step = random.uniform(-0.5, 0.5);
    const double apart = random.uniform(0.1, 0.5);
    const Vec3 foot(side * apart, step, -1.1);
    add(mesh, limb({0.5 * wide * side, 0, 0.1}, {0.7 * side * apart, step + 0.1, -0.45}, foot, 0.16));
    add(mesh, ellipsoid(foot + Vec3{0, 0.1, 0}, {0.07, 0.18, 0.06}));
  }
  if (chance(random, 0.3)) {  // a skirt or a cloak
    add(mesh, lathe({{random.uniform(0.5, 0.9), -1.0}, {0.7 * wide, 0.6}}));
  }
  return mesh;
}

Mesh bird(Random& random) {
  const double thick = random.uniform(0.15, 0.4);
  Mesh mesh = ellipsoid({0, 0, 0}, {thick, 0.7, thick});
  const Vec3 skull{0, random.uniform(0.6, 1.2), random.uniform(0.1, 0.8)};
  add(mesh, rod({0, 0.4, 0.1}, skull, 0.6 * thick, 0.1));
  add(mesh, ellipsoid(skull, {0.15, 0.2, 0.15}));
  add(mesh, rod(skull, skull + Vec3{0, random.uniform(0.25, 0.6), -0.1}, 0.07, 0.01));
  const double span = random.uniform(0.5, 2.2);
  const double chord = random.uniform(0.3, 0.9);
  const double tip = chord * random.uniform(0.05, 0.9);
  const Mesh wing = fin(span, chord, tip, random.uniform(-0.2, 0.6));
  add(mesh, mirrored(turned(wing, random.uniform(-0.24, 0.1), Vec3::UnitY())));
  add(mesh, moved(turned(fin(random.uniform(0.3, 0.9), 0.2, 0.6, 0.0), -0.25, Vec3::UnitZ()), Vec3{0, -0.5, 0}));
  if (chance(random, 0.5)) {
    add(mesh, mirrored(limb({0.1, 0, -0.2}, {0.12, 0.1, -0.5}, {0.12, 0.0, -random.uniform(0.6, 1.3)}, 0.05)));
  }
  return mesh;
}

Mesh insect(Random& random) {
  Mesh mesh;
  double y = 0.0;
  for (int k = whole(random, 1, 3); k > 0; --k) {
    const double length = random.uniform(0.2, 0.7);
    const double thick = random.uniform(0.12, 0.35);
    y += 0.8 * length;
    add(mesh, ellipsoid({0, y, 0}, {thick, length, 0.9 * thick}));
    y += 0.8 * length;
  }
  const int legs = whole(random, 2, 6);
  const double reach = random.uniform(0.6, 2.0);
  const double knee = random.uniform(0.0, 0.8);
  const double thin = random.uniform(0.025, 0.08);
  for (int k = 0; k < legs; ++k) {
    const double at = y * (0.3 + 0.4 * k / legs);
    const double fan = (k - 0.5 * (legs - 1)) * random.uniform(0.2, 0.5);
    add(mesh, mirrored(tube({{0, at, 0}, {0.5 * reach, at + 0.5 * fan, knee}, {reach, at + fan, -0.4}}, thin, 6)));
  }
  if (chance(random, 0.5)) {
    const double span = random.uniform(0.7, 1.8);
    const double tip = random.uniform(0.3, 1.2);
    const Mesh wing = fin(span, 0.3, tip, random.uniform(-0.3, 0.8));
    add(mesh, mirrored(moved(turned(wing, -0.06, Vec3::UnitY()), Vec3{0, 0.5 * y, 0.1})));
  }
  return mesh;
}

Mesh fish(Random& random) {
  const double deep = random.uniform(0.15, 0.6);
  const double wide = random.uniform(0.08, 0.3);
  const double bend = random.uniform(-0.3, 0.3);
  Mesh mesh = ellipsoid({0, 0, 0}, {wide, 1.0, deep});
  const double tail_length = random.uniform(0.3, 0.7);
  const Mesh tail = fin(tail_length, 0.15, random.uniform(0.4, 1.0), 0.0);
  // Wings lie in the xy-plane; the tail and the fin on the back stand in the yz-plane.
  const Mesh upright = turned(tail, 0.25, Vec3::UnitY());
  add(mesh, moved(turned(upright, chance(random, 0.5) ? 0.25 : -0.25, Vec3::UnitX()), Vec3{0, -0.85, 0}));
  add(mesh, moved(turned(fin(random.uniform(0.2, 0.6), 0.6, 0.2, 0.2), -0.25, Vec3::UnitY()), Vec3{0, 0, 0.8 * deep}));
  add(mesh, mirrored(moved(turned(fin(random.uniform(0.2, 0.7), 0.3, 0.1, 0.3), 0.05, Vec3::UnitY()),
                           Vec3{0.7 * wide, 0.3, -0.1})));
  for (Vec3& v : mesh.vertices) {
    v.x() += bend * v.y() * v.y();
  }
  return mesh;
}

Mesh head(Random& random) {
  const Vec3 size{random.uniform(0.65, 0.85), random.uniform(0.75, 1.0), 1.0};
  const double chin = random.uniform(0.0, 0.4);
  Mesh mesh = globe([](const Vec3&) { return 1.0; });
  for (Vec3& v : mesh.vertices) {
    v = v.cwiseProduct(size);
    v.x() *= 1.0 + chin * std::min(v.z(), 0.0);
  }
  const double nose = random.uniform(0.1, 0.35);
  add(mesh, rod({0, 0.9 * size.y(), 0.2}, {0, size.y() + nose, -0.15}, 0.05, 0.13));
  add(mesh, mirrored(ellipsoid({size.x(), 0, 0}, {0.08, 0.18, random.uniform(0.15, 0.5)})));
  add(mesh, mirrored(ellipsoid({0.3, 0.85 * size.y(), 0.25}, Vec3::Constant(random.uniform(0.08, 0.18)))));
  add(mesh, ellipsoid({0, 0.85 * size.y(), -0.4}, {0.3, 0.12, 0.08}));
  if (chance(random, 0.6)) {
    const double neck = random.uniform(1.1, 1.8);
    add(mesh, rod({0, -0.1, -0.6}, {0, -0.2, -neck}, 0.4, random.uniform(0.4, 0.6)));
  }
  if (chance(random, 0.4)) {  // a bust
    add(mesh, ellipsoid({0, -0.2, -1.8}, {random.uniform(0.8, 1.5), 0.5, 0.6}));
  }
  if (chance(random, 0.4)) {  // hair or a helmet
    add(mesh, ellipsoid({0, -0.15, 0.25}, size * random.uniform(1.02, 1.2)));
  }
  return mesh;
}

Mesh hand(Random& random) {
  const double curl = random.uniform(0.0, 0.9);
  Mesh mesh = ellipsoid({0, 0, 0}, {0.5, 0.6, 0.2});
  for (int k = 0; k < 4; ++k) {
    const double x = 0.27 * (k - 1.5);
    const double length = random.uniform(0.6, 1.0);
    const double bend = curl * random.uniform(0.3, 1.2);
    const Vec3 knuckle(x, 0.4, 0);
    const Vec3 joint = knuckle + Vec3{0.3 * x, 0.5 * length, -0.2 * bend};
    add(mesh,
        limb(knuckle, joint, joint + length * Vec3{0.2 * x, std::cos(bend), -std::sin(bend)}.normalized() * 0.6, 0.14));
  }
  add(mesh, limb({0.4, -0.2, 0}, {0.75, 0.1, -0.2 * curl}, {random.uniform(0.6, 1.0), 0.5, -0.5 * curl}, 0.16));
  if (chance(random, 0.6)) {
    add(mesh, rod({0, -0.4, 0}, {0, -random.uniform(1.0, 2.0), 0}, 0.27, 0.35));
  }
  return mesh;
}

Mesh worm(Random& random) {
  std::vector<Vec3> points = {Vec3::Zero()};
  const double flat = random.uniform(0.1, 1.0);
  for (int k = whole(random, 3, 7); k > 0; --k) {
    const Vec3 step = direction(random).cwiseProduct(Vec3{1.0, 1.0, flat}) + Vec3{0.5, 0.0, 0.0};
    points.push_back(points.back() + step);
  }
  const std::vector<Vec3> path = smooth(points);
  const double thick = random.uniform(0.08, 0.35);
  const double taper = random.uniform(0.0, 0.95);
  std::vector<double> radii;
  for (std::size_t i = 0; i < path.size(); ++i) {
    radii.push_back(thick * (1.0 - taper * static_cast<double>(i) / static_cast<double>(path.size())));
  }
  Mesh mesh = tube(path, radii);
  if (chance(random, 0.5)) {
    add(mesh, ellipsoid(path.front(), Vec3::Constant(random.uniform(1.0, 1.8) * thick)));
  }
  return mesh;
}

}  // namespace spincat::background
