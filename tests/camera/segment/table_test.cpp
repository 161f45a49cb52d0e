#include "spincat/camera/segment/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "spincat/camera/render/sensor_noise.h"
#include "support/scenes.h"

namespace spincat {
namespace {

using test::moved;
using test::Scene;

double degrees_between(const SupportPlane& a, const SupportPlane& b) {
  return std::acos(std::min(1.0, static_cast<double>(a.normal.dot(b.normal)))) * 180.0 / 3.14159265358979;
}

Scene with_boxes() {
  Scene scene;
  scene.things = {moved(test::box(0.1, 0.15, 0.2), {-0.2, 0.0, 0.1}),
                  moved(test::box(0.2, 0.1, 0.1), {0.15, 0.1, 0.05})};
  return scene;
}

TEST(FindTable, FindsItBelowThings) {
  const Scene scene = with_boxes();
  DepthImage image = scene.picture();
  Random random(1);
  add_sensor_noise(scene.intrinsics, 1.0, random, image);
  const std::optional<SupportPlane> table = find_table(image, scene.intrinsics, {});
  ASSERT_TRUE(table);
  EXPECT_LT(degrees_between(*table, scene.table()), 0.3);
  EXPECT_NEAR(table->offset, 0.7, 0.003);
  EXPECT_GT(table->share, 0.5);
}

TEST(FindTable, FindsItWhenTheCameraIsRolled) {
  Scene scene = with_boxes();
  const Eigen::Matrix3d rolled = Eigen::AngleAxisd(1.5707963, Vec3::UnitZ()) * scene.viewpoint.axes;
  scene.viewpoint.axes = rolled;
  const std::optional<SupportPlane> table = find_table(scene.picture(), scene.intrinsics, {});
  ASSERT_TRUE(table);
  EXPECT_LT(degrees_between(*table, scene.table()), 0.1);
}

TEST(FindTable, TellsATableFromAWallWhereUpIsKnown) {
  Scene scene;
  scene.table_half = 0.3;
  scene.things = {moved(test::box(4.0, 0.01, 3.0), {0.0, 0.5, 0.0})};  // a wall, larger in the picture
  const DepthImage image = scene.picture();
  const std::optional<SupportPlane> any = find_table(image, scene.intrinsics, {});
  ASSERT_TRUE(any);
  EXPECT_GT(degrees_between(*any, scene.table()), 80.0);
  TableSettings settings;
  settings.up = scene.table().normal;
  const std::optional<SupportPlane> table = find_table(image, scene.intrinsics, settings);
  ASSERT_TRUE(table);
  EXPECT_LT(degrees_between(*table, scene.table()), 0.5);
}

TEST(FindTable, KeepsTheOneBeforeWhereAnotherIsHardlyBetter) {
  // Two steps of a stair, the higher one a little larger in the picture.
  Scene scene;
  scene.table_half = 0.0;
  scene.things = {moved(test::box(0.8, 0.19, 0.1), {0.0, -0.095, -0.05}),
                  moved(test::box(0.8, 0.45, 0.2), {0.0, 0.225, 0.0})};
  const DepthImage image = scene.picture();
  const std::optional<SupportPlane> free_choice = find_table(image, scene.intrinsics, {});
  ASSERT_TRUE(free_choice);
  const float other_offset = free_choice->offset > 0.65F ? 0.6F : 0.7F;
  const SupportPlane other{scene.table().normal, other_offset, 0.3};
  const std::optional<SupportPlane> kept = find_table(image, scene.intrinsics, {}, other);
  ASSERT_TRUE(kept);
  EXPECT_NEAR(kept->offset, other_offset, 0.005F);
}

TEST(FindTable, FindsNoneWhereThereIsNone) {
  const Intrinsics intrinsics;
  EXPECT_FALSE(find_table(DepthImage(640, 480), intrinsics, {}));
  EXPECT_FALSE(find_table(DepthImage(3, 2), intrinsics, {}));
  DepthImage noise(640, 480);
  Random random(5);
  std::ranges::generate(noise.depth, [&] { return static_cast<float>(random.uniform(0.5, 4.0)); });
  EXPECT_FALSE(find_table(noise, intrinsics, {}));
}

TEST(FindTable, IsDeterministic) {
  const DepthImage image = with_boxes().picture();
  const std::optional<SupportPlane> a = find_table(image, {}, {});
  const std::optional<SupportPlane> b = find_table(image, {}, {});
  EXPECT_EQ(a->normal, b->normal);
  EXPECT_EQ(a->offset, b->offset);
}

TEST(TableArea, IsWhatIsSeenAndALittleMore) {
  Scene scene;
  scene.table_half = 0.25;
  const SupportPlane table = scene.table();
  const TableArea area(scene.picture(), scene.intrinsics, table);
  const auto contains = [&](double x, double y, double z) {
    return area.contains(scene.viewpoint.to_camera(Vec3(x, y, z)).cast<float>());
  };
  EXPECT_TRUE(contains(0.0, 0.0, 0.0));
  EXPECT_TRUE(contains(0.24, 0.24, 0.3));
  EXPECT_TRUE(contains(0.26, -0.1, 0.0));
  EXPECT_FALSE(contains(0.35, 0.0, 0.0));
  EXPECT_FALSE(contains(0.0, -0.4, 0.1));
}

TEST(TableArea, IsEmptyWithoutReadings) {
  const TableArea area(DepthImage(64, 48), {}, {});
  EXPECT_TRUE(area.empty());
  EXPECT_FALSE(area.contains(Eigen::Vector3f(0, 0, 1)));
}

}  // namespace
}  // namespace spincat
