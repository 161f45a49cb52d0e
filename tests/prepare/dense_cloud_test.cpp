#include "spincat/prepare/dense_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "spincat/geometry/left_out.h"
#include "spincat/geometry/random.h"
#include "spincat/prepare/prepare.h"
#include "support/shapes.h"

namespace spincat {
namespace {

// Points of a sphere's surface, many times as dense where x > 0.8.
PointCloud uneven_sphere(std::size_t count, const Vec3& centre, double size) {
  Random random(3);
  PointCloud cloud;
  while (cloud.points.size() < count) {
    const Vec3 p = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    if (p.x() > 0.8 || random.below(10) == 0) {
      cloud.points.push_back(centre + size * p);
      cloud.normals.push_back(p);
    }
  }
  return cloud;
}

TEST(WithoutCrowds, LeavesCloudsThatAreNotDense) {
  PointCloud cloud = uneven_sphere(kDense, Vec3::Zero(), 1.0);
  cloud.points[5] = cloud.points[4];
  EXPECT_EQ(without_crowds(cloud).points, cloud.points);
}

TEST(WithoutCrowds, KeepsSomePointsOfEveryPlace) {
  for (const double size : {1.0, 1e-4, 1e5}) {
    const PointCloud cloud = uneven_sphere(300'000, Vec3(3, -2, 5) * size, size);
    const PointCloud some = without_crowds(cloud);
    ASSERT_LE(some.points.size(), kDense);
    ASSERT_GT(some.points.size(), kDense / 8);
    EXPECT_EQ(some.points.size() + some.left_out.size(), cloud.points.size());
    const std::vector<std::uint32_t> rows = rows_of_kept(some.points.size(), some.left_out);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(some.points[i], cloud.points[rows[i]]);
      ASSERT_EQ(some.normals[i], cloud.normals[rows[i]]);
    }
    // As many on one side as on the other, where the cloud has many more on one.
    const auto is_left = [&](const Vec3& p) { return p.x() < (3 - 0.8) * size; };
    const auto is_right = [&](const Vec3& p) { return p.x() > (3 + 0.8) * size; };
    const auto left = static_cast<double>(std::ranges::count_if(some.points, is_left));
    const auto right = static_cast<double>(std::ranges::count_if(some.points, is_right));
    EXPECT_LT(right, 1.5 * left);
    EXPECT_GT(static_cast<double>(std::ranges::count_if(cloud.points, is_right)),
              5.0 * static_cast<double>(std::ranges::count_if(cloud.points, is_left)));
  }
}

TEST(WithoutCrowds, KeepsWhatLiesApart) {
  PointCloud cloud = uneven_sphere(100'000, Vec3::Zero(), 1.0);
  cloud.normals.clear();
  cloud.sensor = Vec3(0, 0, 9);
  cloud.points[7] = Vec3(1e30, 0, 0);
  cloud.points[70'000] = Vec3(3, 3, 3);
  const PointCloud some = without_crowds(cloud);
  EXPECT_EQ(std::ranges::count(some.points, Vec3(1e30, 0, 0)), 1);
  EXPECT_EQ(std::ranges::count(some.points, Vec3(3, 3, 3)), 1);
  EXPECT_EQ(some.sensor, cloud.sensor);
  EXPECT_TRUE(some.normals.empty());
}

TEST(WithoutCrowds, TakesNoNoticeOfWhereNothingWasMeasured) {
  const PointCloud clean = uneven_sphere(100'000, Vec3(0, 0, 2), 0.1);
  PointCloud cloud = clean;
  cloud.points.insert(cloud.points.begin(), 20'000, Vec3::Zero());
  cloud.normals.insert(cloud.normals.begin(), 20'000, Vec3(0, 0, 1));
  EXPECT_EQ(without_crowds(cloud).points, without_crowds(clean).points);
}

TEST(WithoutCrowds, ADenseCloudIsPreparedLikeAThinOne) {
  PointCloud cloud = uneven_sphere(200'000, Vec3::Zero(), 1.0);
  cloud.normals.clear();
  cloud.points.emplace_back(40, 0, 0);
  const PreparedObject prepared = prepare(cloud, PrepareSettings{}, 1);
  EXPECT_NEAR(prepared.scale, 1.0, 0.01) << "the point far away has no part in it";
  EXPECT_EQ(prepared.surface.size(), 2048U);
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    ASSERT_GT(prepared.surface.normal(i).dot(prepared.surface.position(i)), 0.9F);
  }
}

}  // namespace
}  // namespace spincat
