#include "spincat/camera/segment/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
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

// Without up a camera is taken not to be upside down.
TEST(FindTable, TellsATableFromAWall) {
  Scene scene;
  scene.table_half = 0.3;
  scene.things = {moved(test::box(4.0, 0.01, 3.0), {0.0, 0.5, 0.0})};  // a wall, larger in the picture
  const DepthImage image = scene.picture();
  const std::optional<SupportPlane> any = find_table(image, scene.intrinsics, {});
  ASSERT_TRUE(any);
  EXPECT_LT(degrees_between(*any, scene.table()), 0.5);
  const Eigen::Matrix3d rolled = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()) * scene.viewpoint.axes;
  scene.viewpoint.axes = rolled;
  TableSettings settings;
  settings.up = scene.table().normal;
  const std::optional<SupportPlane> table = find_table(scene.picture(), scene.intrinsics, settings);
  ASSERT_TRUE(table);
  EXPECT_LT(degrees_between(*table, scene.table()), 0.5);
}

// A small table before a large floor, and a table on a floor that is seen from far.
TEST(FindTable, ChoosesBetweenATableAndTheFloor) {
  Scene scene;
  scene.table_half = 0.35;
  scene.things = {moved(test::box(8.0, 8.0, 0.01), {0.0, 0.0, -0.7})};
  scene.viewpoint = Viewpoint::looking_at({0.0, -1.0, 0.9}, {0.0, 0.0, 0.0});
  const auto offset = [&](SceneKind kind) {
    TableSettings settings;
    settings.scene = kind;
    const std::optional<SupportPlane> found = find_table(scene.picture(), scene.intrinsics, settings);
    return found ? found->offset : 0.0F;
  };
  EXPECT_NEAR(offset(SceneKind::automatic), 0.9F, 0.01F);
  EXPECT_NEAR(offset(SceneKind::table), 0.9F, 0.01F);
  EXPECT_NEAR(offset(SceneKind::floor), 1.595F, 0.01F);
  scene.table_half = 0.2;
  scene.viewpoint = Viewpoint::looking_at({0.0, -2.5, 1.2}, {0.0, 0.0, -0.3});
  EXPECT_NEAR(offset(SceneKind::automatic), 1.895F, 0.02F);
}

// Most readings are of things, and the table is seen between them alone.
TEST(FindTable, FindsAFullTableByAnySeed) {
  Scene scene;
  scene.table_half = 0.45;
  for (int k = 0; k < 30; ++k) {
    scene.things.push_back(moved(test::box(0.09, 0.12, 0.1 + 0.03 * (k % 4)),
                                 {-0.37 + 0.148 * (k % 6), -0.36 + 0.18 * static_cast<double>(k / 6), 0.05}));
  }
  DepthImage image = scene.picture();
  Random random(3);
  add_sensor_noise(scene.intrinsics, 1.0, random, image);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TableSettings settings;
    settings.seed = seed;
    const std::optional<SupportPlane> table = find_table(image, scene.intrinsics, settings);
    ASSERT_TRUE(table);
    EXPECT_LT(degrees_between(*table, scene.table()), 1.0) << seed;
  }
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
  const auto place = [&](double x, double y, double z) {
    return area.place_of(scene.viewpoint.to_camera(Vec3(x, y, z)).cast<float>());
  };
  EXPECT_EQ(place(0.0, 0.0, 0.0), TableArea::Place::inside);
  EXPECT_EQ(place(0.22, 0.22, 0.3), TableArea::Place::inside);
  EXPECT_EQ(place(0.3, -0.1, 0.0), TableArea::Place::rim);
  EXPECT_EQ(place(0.42, 0.0, 0.0), TableArea::Place::outside);
  EXPECT_EQ(place(0.0, -0.42, 0.1), TableArea::Place::outside);
}

// Another table at the same height, with the floor seen between them, is none of it.
TEST(TableArea, EndsWhereTheFloorIsSeen) {
  Scene scene;
  scene.table_half = 0.25;
  scene.things = {moved(test::table_top(0.25), {0.8, 0.0, 0.0}), moved(test::table_top(3.0), {0.0, 0.0, -0.6})};
  scene.viewpoint = Viewpoint::looking_at({0.3, -1.2, 0.9}, {0.3, 0.0, 0.0});
  const TableArea area(scene.picture(), scene.intrinsics, scene.table());
  int inside = 0;
  for (const double x : {0.0, 0.4, 0.8}) {
    const Eigen::Vector3f point = scene.viewpoint.to_camera(Vec3(x, 0.0, 0.0)).cast<float>();
    inside += area.place_of(point) == TableArea::Place::inside ? 1 : 0;
  }
  EXPECT_EQ(inside, 1);
}

// A thing hides a strip of the table from one edge to the other: both parts are one table.
TEST(TableArea, GoesOnBehindAThing) {
  Scene scene;
  scene.table_half = 0.3;
  scene.things = {moved(test::box(0.62, 0.05, 0.1), {0.0, 0.0, 0.05})};
  const TableArea area(scene.picture(), scene.intrinsics, scene.table());
  for (const double y : {-0.25, 0.0, 0.25}) {
    EXPECT_EQ(area.place_of(scene.viewpoint.to_camera(Vec3(0.0, y, 0.0)).cast<float>()), TableArea::Place::inside) << y;
  }
}

TEST(TableArea, IsEmptyWithoutReadings) {
  const TableArea area(DepthImage(64, 48), {}, {});
  EXPECT_TRUE(area.empty());
  EXPECT_EQ(area.place_of(Eigen::Vector3f(0, 0, 1)), TableArea::Place::outside);
}

}  // namespace
}  // namespace spincat
