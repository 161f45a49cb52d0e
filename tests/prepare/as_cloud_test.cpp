#include "spincat/prepare/as_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

TEST(AsCloud, WithoutNoiseLiesOnTheSurface) {
  // A cube of edge 2 far from the origin.
  Mesh mesh = test::box(2, 2, 2);
  Vec3 low = mesh.vertices[0];
  for (Vec3& v : mesh.vertices) {
    v += Vec3(100, -50, 7);
  }
  low = mesh.vertices[0];
  Vec3 high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const PointCloud cloud = as_cloud(mesh, 600, 0.0, 1);
  ASSERT_EQ(cloud.points.size(), 600U);
  EXPECT_TRUE(cloud.normals.empty());
  int on_x_faces = 0;
  for (const Vec3& p : cloud.points) {
    const double inside = std::min((p - low).minCoeff(), (high - p).minCoeff());
    EXPECT_NEAR(inside, 0.0, 1e-9);
    on_x_faces += std::min(p.x() - low.x(), high.x() - p.x()) < 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(on_x_faces, 200, 50);  // two of six faces, four standard deviations
}

TEST(AsCloud, NoiseIsInDiameters) {
  // All points of a cloud are kept, so that each one's error is seen. Its furthest points are 5 from the middle.
  PointCloud given;
  for (int i = 0; i < 4000; ++i) {
    given.points.emplace_back(i % 2 == 0 ? -5.0 : 5.0, 1e-6 * i, 0.0);
  }
  given.sensor = Vec3(1, 2, 3);
  given.normals.assign(4000, Vec3(0, 0, 1));
  const PointCloud cloud = as_cloud(given, 10, 0.01, 1);
  ASSERT_EQ(cloud.points.size(), 4000U);
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_EQ(cloud.sensor, given.sensor);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < 4000; ++i) {
      const double error = (cloud.points[i] - given.points[i])[axis];
      sum += error;
      squares += error * error;
    }
    EXPECT_NEAR(sum / 4000, 0.0, 0.008);                 // five standard errors
    EXPECT_NEAR(std::sqrt(squares / 4000), 0.1, 0.006);  // 1 % of a diameter of 10
  }
}

TEST(AsCloud, DependsOnTheSeedAlone) {
  const Object box = test::box();
  EXPECT_EQ(as_cloud(box, 50, 0.01, 3).points, as_cloud(box, 50, 0.01, 3).points);
  EXPECT_NE(as_cloud(box, 50, 0.01, 3).points, as_cloud(box, 50, 0.01, 4).points);
}

TEST(AsCloud, ExtremeUnitsKeepTheShape) {
  for (const double unit : {1e-200, 1e200}) {
    Mesh mesh = test::box();
    for (Vec3& v : mesh.vertices) {
      v *= unit;
    }
    const PointCloud found = as_cloud(mesh, 20, 0.0, 1);
    const PointCloud usual = as_cloud(test::box(), 20, 0.0, 1);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_LT((found.points[i] / unit - usual.points[i]).norm(), 1e-9);
    }
  }
}

TEST(AsCloud, AMeshWithoutAreaIsTheCloudOfItsVertices) {
  const Mesh line{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(9, 9, 9)}, {{0, 1, 2}}};
  EXPECT_EQ(as_cloud(line, 100, 0.0, 1).points, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}));
}

TEST(AsCloud, NothingIsRefused) {
  EXPECT_NE(test::input_error([] { as_cloud(Mesh{}, 10, 0.0, 1); }), "");
}

}  // namespace
}  // namespace spincat
