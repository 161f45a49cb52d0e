#include "spincat/background/pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace spincat::background {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Vec3 some_perpendicular(const Vec3& direction) {
  return direction.unitOrthogonal();
}

Vec3 tangent(const std::vector<Vec3>& path, std::size_t i) {
  const Vec3 along = path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1];
  return along.norm() > 1e-12 ? Vec3(along.normalized()) : Vec3::UnitZ();
}

// For each point of a path a direction across it, that turns no more than the path does.
std::vector<Vec3> carried_along(const std::vector<Vec3>& path) {
  std::vector<Vec3> across;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 along = tangent(path, i);
    const Vec3 before = i == 0 ? some_perpendicular(along) : across.back();
    const Vec3 kept = before - along * along.dot(before);
    across.push_back(kept.norm() > 1e-6 ? Vec3(kept.normalized()) : some_perpendicular(along));
  }
  return across;
}

Vec3 between(const Vec3& before, const Vec3& from, const Vec3& to, const Vec3& after, double t) {
  const Vec3 curve = (to - before) * t + (2.0 * before - 5.0 * from + 4.0 * to - after) * (t * t) +
                     (3.0 * (from - to) + after - before) * (t * t * t);
  return from + 0.5 * curve;
}

}  // namespace

int whole(Random& random, int low, int high) {
  return low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low + 1)));
}

bool chance(Random& random, double p) {
  return random.uniform() < p;
}

Vec3 vector(Random& random, double low, double high) {
  Vec3 v;
  for (double& x : v) {
    x = random.uniform(low, high);
  }
  return v;
}

Vec3 direction(Random& random) {
  const double z = random.uniform(-1.0, 1.0);
  const Vec2 around = on_circle(random.uniform()) * std::sqrt(1.0 - z * z);
  return {around.x(), around.y(), z};
}

Vec2 on_circle(double turns) {
  return {std::cos(kTurn * turns), std::sin(kTurn * turns)};
}

Mesh surface(int rows, int columns, const std::function<Vec3(double u, double v)>& place) {
  Mesh mesh;
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      mesh.vertices.push_back(place(static_cast<double>(r) / rows, static_cast<double>(c) / columns));
    }
  }
  const auto index = [columns](int r, int c) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      mesh.triangles.push_back({index(r, c), index(r, c + 1), index(r + 1, c + 1)});
      mesh.triangles.push_back({index(r, c), index(r + 1, c + 1), index(r + 1, c)});
    }
  }
  return mesh;
}

Mesh globe(const std::function<double(const Vec3& direction)>& radius) {
  return surface(16, 24, [&](double u, double v) {
    const Vec2 up = on_circle(0.5 * u);
    const Vec2 sideways = on_circle(v) * up.y();
    const Vec3 towards(sideways.x(), sideways.y(), up.x());
    return Vec3(towards * radius(towards));
  });
}

Mesh ellipsoid(const Vec3& centre, const Vec3& radii) {
  return moved(stretched(globe([](const Vec3&) { return 1.0; }), radii), centre);
}

Mesh box(const Vec3& centre, const Vec3& size) {
  const double side = std::sqrt(0.5);  // a lathe of four sides gives a square with this radius
  const Mesh cube = lathe({{0, -0.5}, {side, -0.5}, {side, 0.5}, {0, 0.5}}, 4);
  return moved(stretched(turned(cube, 0.125, Vec3::UnitZ()), size), centre);
}

Mesh lathe(const std::vector<Vec2>& profile, int sides) {
  const double last = static_cast<double>(profile.size() - 1);
  return surface(static_cast<int>(last), sides, [&](double u, double v) {
    const Vec2& at = profile[static_cast<std::size_t>(std::lround(u * last))];
    const Vec2 around = on_circle(v) * at.x();
    return Vec3(around.x(), around.y(), at.y());
  });
}

Mesh tube(const std::vector<Vec3>& path, const std::vector<double>& radii, int sides) {
  const std::vector<Vec3> across = carried_along(path);
  const int rows = static_cast<int>(path.size()) + 1;  // a row of no radius at each end closes it
  return surface(rows, sides, [&](double u, double v) {
    const auto row = static_cast<int>(std::lround(u * rows));
    const auto i = static_cast<std::size_t>(std::clamp(row - 1, 0, rows - 2));
    const Vec2 around = on_circle(v) * (row == 0 || row == rows ? 0.0 : radii[i]);
    return Vec3(path[i] + across[i] * around.x() + tangent(path, i).cross(across[i]) * around.y());
  });
}

Mesh tube(const std::vector<Vec3>& path, double radius, int sides) {
  return tube(path, std::vector<double>(path.size(), radius), sides);
}

Mesh rod(const Vec3& from, const Vec3& to, double radius, double end_radius) {
  return tube({from, to}, {radius, end_radius}, 10);
}

Mesh ring(double radius, double thickness) {
  return surface(32, 10, [&](double u, double v) {
    const Vec2 round = on_circle(v) * thickness;
    const Vec2 around = on_circle(u) * (radius + round.x());
    return Vec3(around.x(), around.y(), round.y());
  });
}

Mesh plate(const std::vector<Vec2>& outline, double thickness, double hole) {
  const double half = 0.5 * thickness;
  const std::vector<Vec2> profile = {{hole, -half}, {1.0, -half}, {1.0, half}, {hole, half}, {hole, -half}};
  return surface(4, static_cast<int>(outline.size()), [&](double u, double v) {
    const Vec2& at = profile[static_cast<std::size_t>(std::lround(4.0 * u))];
    const auto corner = static_cast<std::size_t>(std::lround(v * static_cast<double>(outline.size())));
    const Vec2 edge = outline[corner % outline.size()] * at.x();
    return Vec3(edge.x(), edge.y(), at.y());
  });
}

Mesh leaf(double length, double width, double droop) {
  return surface(8, 2, [&](double u, double v) {
    const double across = width * (v - 0.5) * std::sin(std::numbers::pi * (0.05 + 0.95 * u));
    return Vec3(length * u, across, length * (0.6 * u - droop * u * u) + 0.3 * std::abs(across));
  });
}

std::vector<Vec3> smooth(const std::vector<Vec3>& points) {
  constexpr int kPieces = 8;
  std::vector<Vec3> curve = {points.front()};
  const std::size_t last = points.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    for (int k = 1; k <= kPieces; ++k) {
      const double t = static_cast<double>(k) / kPieces;
      curve.push_back(between(points[i == 0 ? 0 : i - 1], points[i], points[i + 1], points[std::min(i + 2, last)], t));
    }
  }
  return curve;
}

void add(Mesh& mesh, const Mesh& piece) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), piece.vertices.begin(), piece.vertices.end());
  for (const Triangle& t : piece.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

Mesh moved(Mesh mesh, const Eigen::Affine3d& motion) {
  for (Vec3& v : mesh.vertices) {
    v = motion * v;
  }
  return mesh;
}

Mesh moved(Mesh mesh, const Vec3& by) {
  return moved(std::move(mesh), Eigen::Affine3d(Eigen::Translation3d(by)));
}

Mesh stretched(Mesh mesh, const Vec3& by) {
  return moved(std::move(mesh), Eigen::Affine3d(Eigen::Scaling(by)));
}

Mesh turned(Mesh mesh, double turns, const Vec3& axis) {
  return moved(std::move(mesh), Eigen::Affine3d(Eigen::AngleAxisd(kTurn * turns, axis.normalized())));
}

Mesh mirrored(Mesh mesh) {
  const Mesh image = stretched(mesh, Vec3{-1, 1, 1});
  add(mesh, image);
  return mesh;
}

Mesh around(const Mesh& mesh, int count) {
  Mesh all;
  for (int k = 0; k < count; ++k) {
    add(all, turned(mesh, static_cast<double>(k) / count, Vec3::UnitZ()));
  }
  return all;
}

}  // namespace spincat::background
