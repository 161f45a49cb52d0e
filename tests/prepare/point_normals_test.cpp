#include "spincat/prepare/point_normals.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "spincat/geometry/random.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

using test::input_error;

std::vector<Vec3> square(double scale, const Vec3& at) {
  Random random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {
    points.push_back(at + scale * Vec3(random.uniform(), random.uniform(), 0.0));
  }
  return points;
}

TEST(PointNormals, PointToThePlaceTheyAreSeenFrom) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    const std::vector<Vec3> points = square(scale, Vec3::Zero());
    for (const double side : {1.0, -1.0}) {
      for (const Vec3& n : estimate_normals(points, 8, Vec3(0, 0, side * scale))) {
        EXPECT_LE((n - Vec3(0, 0, side)).norm(), 1e-9) << scale;
      }
    }
  }
}

TEST(PointNormals, PointAwayFromTheMiddleWhereNoPlaceIsGiven) {
  std::vector<Vec3> points = square(1.0, {0, 0, 1});
  for (const Vec3& p : square(1.0, {0, 0, -1})) {
    points.push_back(p);
  }
  const std::vector<Vec3> normals = estimate_normals(points, 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(normals[i].dot(Vec3(0, 0, points[i].z())), 0.99);
  }
}

TEST(PointNormals, RefuseWhatHasNone) {
  const std::vector<Vec3> points = square(1.0, Vec3::Zero());
  EXPECT_EQ(input_error([&] { estimate_normals(points, 2); }), "neighbours 2: expected 3 to 1,000");
  EXPECT_NE(input_error([&] { estimate_normals({}, 8); }), "no error");
  EXPECT_NE(input_error([&] { estimate_normals(std::vector<Vec3>(5, Vec3(1, 2, 3)), 8); }), "no error");
  std::vector<Vec3> odd = points;
  odd[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(input_error([&] { estimate_normals(odd, 8); }), "point 7 is not finite");
}

}  // namespace
}  // namespace spincat
