// Surfaces that a formula gives.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "spincat/background/families.h"
#include "spincat/background/pieces.h"

namespace spincat::background {
namespace {

double signed_power(double x, double exponent) {
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

// A landscape of waves: the sum of `count` of random direction and length.
std::function<double(double x, double y)> waves(Random& random, int count, double longest) {
  struct Wave {
    Vec2 direction;
    double phase;
    double height;
  };
  std::vector<Wave> all;
  for (int k = 0; k < count; ++k) {
    const double frequency = (1.0 + random.uniform() * k) / longest;
    const Vec2 direction = on_circle(random.uniform()) * frequency;
    const double phase = random.uniform();
    all.push_back({direction, phase, random.uniform(0.3, 1.0) / (1.0 + k)});
  }
  return [all](double x, double y) {
    double sum = 0.0;
    for (const Wave& w : all) {
      sum += w.height * on_circle(w.direction.dot(Vec2(x, y)) + w.phase).x();
    }
    return sum;
  };
}

}  // namespace

Mesh superquadric(Random& random) {
  const double up = random.uniform(0.15, 2.5);
  const double sideways = random.uniform(0.15, 2.5);
  const Vec3 size = vector(random, 0.25, 1.0);
  const double taper = random.uniform(-0.7, 0.7);
  const double bend = random.uniform(-0.5, 0.5);
  return surface(20, 32, [&](double u, double v) {
    const Vec2 a = on_circle(0.5 * u);
    const Vec2 b = on_circle(v);
    const double z = signed_power(a.x(), up);
    const double r = signed_power(std::max(a.y(), 0.0), up) * (1.0 + taper * z);
    const double x = size.x() * r * signed_power(b.x(), sideways);
    return Vec3(x + bend * z * z, size.y() * r * signed_power(b.y(), sideways), size.z() * z);
  });
}

Mesh wavy_ring(Random& random) {
  const double thickness = random.uniform(0.1, 0.6);
  const double flat = random.uniform(0.3, 2.0);
  const int folds = whole(random, 0, 8);
  const double wave = folds == 0 ? 0.0 : random.uniform(0.0, 0.4);
  const double lift = random.uniform(0.0, 0.5);
  const double corner = random.uniform(0.2, 1.2);
  return surface(64, 12, [&](double u, double v) {
    const double beat = on_circle(folds * u).x();
    const Vec2 round = on_circle(v) * (thickness * (1.0 + wave * beat));
    const Vec2 axis = on_circle(u);
    const double r = 1.0 + signed_power(round.x() / thickness, corner) * thickness;
    return Vec3(axis.x() * r, axis.y() * r, flat * round.y() + lift * beat);
  });
}

Mesh knot(Random& random) {
  const int p = whole(random, 1, 4);
  const int q = p + whole(random, 1, 4);
  const double inner = random.uniform(0.2, 0.6);
  const double flat = random.uniform(0.3, 1.5);
  std::vector<Vec3> path;
  for (int k = 0; k <= 128; ++k) {
    const double t = k / 128.0;
    const Vec2 axis = on_circle(p * t) * (1.0 + inner * on_circle(q * t).x());
    path.emplace_back(axis.x(), axis.y(), flat * inner * on_circle(q * t).y());
  }
  return tube(path, random.uniform(0.05, 0.25));
}

Mesh spring(Random& random) {
  const int turns = whole(random, 2, 8);
  const double height = random.uniform(0.5, 4.0);
  const double end = random.uniform(0.2, 1.3);
  const double thickness = std::min(random.uniform(0.03, 0.25), 0.45 * height / turns + 0.02);
  std::vector<Vec3> path;
  for (int k = 0; k <= 20 * turns; ++k) {
    const double t = k / (20.0 * turns);
    const Vec2 at = on_circle(turns * t) * (1.0 + (end - 1.0) * t);
    path.emplace_back(at.x(), at.y(), height * t);
  }
  return tube(path, thickness);
}

Mesh snail_shell(Random& random) {
  const double turns = random.uniform(0.4, 4.0);
  const double growth = random.uniform(0.8, 2.5);
  const double climb = random.uniform(0.0, 2.0);
  const double wide = random.uniform(0.25, 0.6);
  return surface(80, 12, [&](double u, double v) {
    const double size = std::exp(growth * (u - 1.0) * std::min(turns, 2.0));
    const Vec2 axis = on_circle(turns * u);
    const Vec2 round = on_circle(v) * (wide * size);
    const double r = size + round.x();
    return Vec3(axis.x() * r, axis.y() * r, climb * (1.0 - size) + round.y());
  });
}

Mesh blob(Random& random) {
  std::vector<std::pair<Vec3, double>> bumps;
  for (int k = whole(random, 2, 12); k > 0; --k) {
    const Vec3 towards = direction(random);
    bumps.emplace_back(towards, random.uniform(-0.4, 0.9));
  }
  const double sharp = random.uniform(2.0, 14.0);
  const Vec3 size = vector(random, 0.5, 1.0);
  return stretched(globe([&](const Vec3& d) {
                     double r = 1.0;
                     for (const auto& [towards, height] : bumps) {
                       r += height * std::exp(sharp * (d.dot(towards) - 1.0));
                     }
                     return std::max(r, 0.15);
                   }),
                   size);
}

Mesh crystal(Random& random) {
  std::vector<std::pair<Vec3, double>> planes = {{{1, 0, 0}, 1},  {{-1, 0, 0}, 1}, {{0, 1, 0}, 1},
                                                 {{0, -1, 0}, 1}, {{0, 0, 1}, 1},  {{0, 0, -1}, 1}};
  for (int k = whole(random, 2, 14); k > 0; --k) {
    const Vec3 towards = direction(random);
    planes.emplace_back(towards, random.uniform(0.4, 1.0));
  }
  const Vec3 size = vector(random, 0.3, 1.0);
  return stretched(globe([&](const Vec3& d) {
                     double r = 2.0;
                     for (const auto& [towards, distance] : planes) {
                       r = std::min(r, distance / std::max(d.dot(towards), 1e-3));
                     }
                     return r;
                   }),
                   size);
}

Mesh wavy_sheet(Random& random) {
  const int count = whole(random, 1, 4);
  const double longest = random.uniform(1.0, 4.0);
  const auto height = waves(random, count, longest);
  const double scale = random.uniform(0.1, 0.6);
  const double width = random.uniform(0.3, 1.0);
  const double roll = random.uniform(-0.8, 0.8);
  return surface(24, 24, [&](double u, double v) {
    const double x = 2.0 * u - 1.0;
    const double y = width * (2.0 * v - 1.0);
    return Vec3(x, y * (1.0 - 0.3 * std::abs(roll) * u), scale * height(x, y) + roll * x * x);
  });
}

Mesh landscape(Random& random) {
  const int count = whole(random, 3, 9);
  const double longest = random.uniform(0.7, 2.0);
  const auto height = waves(random, count, longest);
  const double scale = random.uniform(0.05, 0.35);
  const double floor = -random.uniform(0.1, 0.6);
  const double width = random.uniform(0.5, 1.0);
  return surface(30, 30, [&](double u, double v) {
    const double x = std::clamp(1.08 * (2.0 * u - 1.0), -1.0, 1.0);
    const double y = std::clamp(1.08 * (2.0 * v - 1.0), -1.0, 1.0);
    const bool rim = u == 0.0 || u == 1.0 || v == 0.0 || v == 1.0;
    return Vec3(x, width * y, rim ? floor : scale * height(x, y));
  });
}

}  // namespace spincat::background
