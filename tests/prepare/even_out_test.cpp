#include "spincat/prepare/even_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "prepare/seen_surface.h"

namespace spincat {
namespace {

using Key = std::tuple<double, double, double, double, double, double>;

Key key_of(const SurfacePoints& points, std::size_t i) {
  const Vec3& p = points.positions[i];
  const Vec3& n = points.normals[i];
  return {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()};
}

using test::seen_of;
using test::unit_box;

TEST(EvenOut, EvensOutTheDensity) {
  // Two squares of 10 x 10 cells; the left one has 100 points a cell, the right one 9.
  SurfacePoints points;
  const auto add_square = [&](double left, int a_row) {
    const double step = 0.4 / (10 * a_row);
    for (int i = 0; i < 100 * a_row * a_row; ++i) {
      points.positions.emplace_back(left + step * (i % (10 * a_row) + 0.5), step * (i / (10 * a_row) + 0.5), 0.01);
      points.normals.emplace_back(0, 0, 1);
    }
  };
  add_square(-0.8, 10);
  add_square(0.4, 3);
  Random random(1);
  const SurfacePoints even = even_out(points, 200, random);
  const auto left = std::ranges::count_if(even.positions, [](const Vec3& p) { return p.x() < 0.0; });
  EXPECT_NEAR(static_cast<double>(left), 100.0, 35.0);  // five standard deviations of a coin; uneven it would be 183
}

TEST(EvenOut, TheFirstOfADrawAreEvenThemselves) {
  // Three cells of 1, 10 and 100 points: whatever the cell holds, it gives a third of the first points that are drawn.
  std::array<int, 3> first{};
  SurfacePoints points;
  for (const auto& [count, x] : {std::pair(1, 0.02), std::pair(10, 0.5), std::pair(100, 0.9)}) {
    for (int i = 0; i < count; ++i) {
      points.positions.emplace_back(x, 0.01, 1e-4 * i);
      points.normals.emplace_back(0, 0, 1);
    }
  }
  Random random(1);
  for (int draw = 0; draw < 3000; ++draw) {
    const double x = even_out(points, 1, random).positions[0].x();
    ++first[x < 0.1 ? 0 : x < 0.7 ? 1 : 2];
  }
  for (const int count : first) {
    EXPECT_NEAR(count, 1000, 130);  // five standard deviations
  }
}

TEST(EvenOut, TellsTheTwoSidesOfAWallApart) {
  // 100 points face up and 10 face down in one cell: each octant is a cell of its own.
  SurfacePoints points;
  for (int i = 0; i < 110; ++i) {
    points.positions.emplace_back(0.01, 0.01, 1e-5 * i);
    points.normals.emplace_back(0, 0, i < 100 ? 1 : -1);
  }
  int down = 0;
  Random random(1);
  for (int draw = 0; draw < 2000; ++draw) {
    down += even_out(points, 1, random).normals[0].z() < 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(down, 1000, 112);
}

TEST(EvenOut, ALargerDrawBeginsWithTheSmallerOne) {
  const SurfacePoints seen = seen_of(unit_box());
  Random a(9);
  Random b(9);
  const SurfacePoints few = even_out(seen, 50, a);
  const SurfacePoints many = even_out(seen, 500, b);
  ASSERT_EQ(few.positions.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(key_of(few, i), key_of(many, i));
  }
}

TEST(EvenOut, KeepsEachPointOnceWhenThereAreFew) {
  SurfacePoints points;
  points.positions = test::sphere_points(300);
  points.normals = points.positions;
  Random random(1);
  const SurfacePoints all = even_out(points, 1000, random);
  ASSERT_EQ(all.positions.size(), 300U);
  std::set<Key> given;
  std::set<Key> kept;
  for (std::size_t i = 0; i < 300; ++i) {
    given.insert(key_of(points, i));
    kept.insert(key_of(all, i));
  }
  EXPECT_EQ(kept, given);
  EXPECT_NE(all.positions, points.positions);  // in random order
  EXPECT_TRUE(even_out({}, 5, random).positions.empty());
}

TEST(EvenOut, DrawsNoPointTwice) {
  const SurfacePoints seen = seen_of(test::icosphere(2));
  Random random(1);
  const SurfacePoints drawn = even_out(seen, 2048, random);
  std::set<Key> keys;
  for (std::size_t i = 0; i < drawn.positions.size(); ++i) {
    keys.insert(key_of(drawn, i));
  }
  EXPECT_EQ(keys.size(), 2048U);
}

}  // namespace
}  // namespace spincat
