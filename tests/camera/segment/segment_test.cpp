#include "spincat/camera/segment/segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "spincat/camera/render/sensor_noise.h"
#include "spincat/camera/segment/segment_cloud.h"
#include "support/expect_error.h"
#include "support/scenes.h"

namespace spincat {
namespace {

using test::moved;
using test::Scene;

Segmentation segmented(const Scene& scene, SegmentSplit split, double noise = 0.0) {
  DepthImage image = scene.picture();
  if (noise > 0.0) {
    Random random(7);
    add_sensor_noise(scene.intrinsics, noise, random, image);
  }
  SegmentSettings settings;
  settings.split = split;
  return segment(image, scene.intrinsics, scene.table(), settings);
}

// For each thing of the scene the best intersection over union with an object that was found.
std::vector<double> agreement(const Scene& scene, const Segmentation& found) {
  const std::vector<std::size_t> truth = scene.truth();
  std::vector<double> pixels(scene.things.size() + 1, 0.0);
  std::map<std::pair<std::size_t, std::size_t>, double> both;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    pixels[truth[i]] += 1.0;
    both[{truth[i], found.ids[i]}] += 1.0;
  }
  std::vector<double> best(scene.things.size(), 0.0);
  for (const Segment& object : found.objects) {
    for (std::size_t k = 0; k < best.size(); ++k) {
      const double shared = both[{k + 1, object.id}];
      best[k] = std::max(best[k], shared / (pixels[k + 1] + static_cast<double>(object.pixels) - shared));
    }
  }
  return best;
}

Scene two_boxes(double gap) {
  Scene scene;
  const double x = 0.06 + gap / 2.0;
  scene.things = {moved(test::box(0.12, 0.1, 0.15), {-x, 0.0, 0.075}),
                  moved(test::box(0.12, 0.1, 0.08), {x, 0.0, 0.04})};
  return scene;
}

class SplitWays : public testing::TestWithParam<SegmentSplit> {};

TEST_P(SplitWays, FindEachThingThatStandsApart) {
  Scene scene = two_boxes(0.15);
  scene.things.push_back(moved(test::cylinder(48, 0.04, 0.04, 0.2), {0.0, 0.25, 0.0}));
  for (const double noise : {0.0, 1.0}) {
    const Segmentation found = segmented(scene, GetParam(), noise);
    ASSERT_EQ(found.objects.size(), 3U) << noise;
    for (const double share : agreement(scene, found)) {
      EXPECT_GT(share, 0.85) << noise;
    }
  }
}

TEST_P(SplitWays, FindNothingOnAnEmptyTable) {
  Scene scene;
  const Segmentation found = segmented(scene, GetParam(), 1.0);
  EXPECT_TRUE(found.objects.empty());
  EXPECT_EQ(std::ranges::count(found.ids, 0), std::ssize(found.ids));
}

TEST_P(SplitWays, NumberObjectsByTheirFirstPixels) {
  const Segmentation found = segmented(two_boxes(0.15), GetParam());
  ASSERT_EQ(found.objects.size(), 2U);
  std::uint16_t next = 1;
  for (const std::uint16_t id : found.ids) {
    EXPECT_LE(id, next);
    next = id == next ? static_cast<std::uint16_t>(next + 1) : next;
  }
  EXPECT_EQ(next, 3);
}

TEST_P(SplitWays, MeasureAnObject) {
  const Scene scene = two_boxes(0.15);
  const Segmentation found = segmented(scene, GetParam());
  ASSERT_EQ(found.objects.size(), 2U);
  const Segment& left = found.objects[0];  // the higher one comes first
  EXPECT_NEAR(left.height, 0.15F, 0.002F);
  EXPECT_NEAR(left.centre.x(), -0.135F, 0.005F);
  EXPECT_FALSE(left.cut);
  std::size_t pixels = 0;
  for (int v = left.top; v <= left.bottom; ++v) {
    for (int u = left.left; u <= left.right; ++u) {
      pixels += found.ids[static_cast<std::size_t>(v * scene.width + u)] == left.id ? 1 : 0;
    }
  }
  EXPECT_EQ(pixels, left.pixels);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(found.ids, left.id)), left.pixels);
}

INSTANTIATE_TEST_SUITE_P(Ways, SplitWays, testing::Values(SegmentSplit::concave, SegmentSplit::none));

TEST(Segment, PartsStackedBoxesAlongTheirGroove) {
  Scene scene;
  scene.things = {moved(test::box(0.2, 0.2, 0.1), {0.0, 0.0, 0.05}), moved(test::box(0.1, 0.1, 0.1), {0.0, 0.0, 0.15})};
  const Segmentation found = segmented(scene, SegmentSplit::concave, 0.5);
  EXPECT_EQ(found.objects.size(), 2U);
  for (const double share : agreement(scene, found)) {
    EXPECT_GT(share, 0.75);
  }
  EXPECT_EQ(segmented(scene, SegmentSplit::none).objects.size(), 1U);
}

TEST(Segment, KeepsATableTogetherByItsFootprint) {
  Scene scene;  // a little table: a top and four legs, of which the picture shows parts that do not touch
  scene.things = {moved(test::box(0.3, 0.2, 0.02), {0.0, 0.0, 0.19})};
  for (const double x : {-0.14, 0.14}) {
    for (const double y : {-0.09, 0.09}) {
      scene.things.push_back(moved(test::box(0.02, 0.02, 0.18), {x, y, 0.09}));
    }
  }
  const Segmentation found = segmented(scene, SegmentSplit::none);
  EXPECT_EQ(found.objects.size(), 1U);
}

TEST(Segment, SaysWhyThereIsNoObject) {
  Scene scene;
  scene.things = {moved(test::box(0.01, 0.01, 0.03), {-0.2, 0.0, 0.015}),  // small
                  moved(test::box(0.2, 0.2, 0.012), {0.1, 0.0, 0.006}),    // flat
                  moved(test::box(0.1, 0.1, 0.1), {0.0, 0.85, 0.1})};      // behind the table's edge
  const Segmentation found = segmented(scene, SegmentSplit::none);
  EXPECT_TRUE(found.objects.empty());
  EXPECT_GT(found.left_out.too_few, 20U);
  EXPECT_LT(found.left_out.too_few, 300U);
  EXPECT_GT(found.left_out.too_low, 1000U);
  EXPECT_GT(found.left_out.outside, 300U);
}

// Boxes in rows, so close that the table between them is seen in strips alone.
TEST(Segment, FindsThingsOnAFullTable) {
  Scene scene;
  scene.table_half = 0.45;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      scene.things.push_back(moved(test::box(0.1, 0.1, 0.06 + 0.02 * ((row + column) % 3)),
                                   {-0.36 + 0.18 * column, -0.33 + 0.22 * row, 0.04}));
    }
  }
  for (const SegmentSplit split : {SegmentSplit::none, SegmentSplit::concave}) {
    const std::vector<double> shares = agreement(scene, segmented(scene, split, 1.0));
    EXPECT_GE(std::ranges::count_if(shares, [](double share) { return share > 0.75; }), 19);
  }
}

// Walls right behind a table, that come up from below it and that end on it, and a floor.
TEST(Segment, TakesNoWallForAThing) {
  for (const double gap : {0.0, 0.01, 0.03, 0.06, 0.2}) {
    for (const double turn : {0.0, 0.5}) {
      Scene scene = two_boxes(0.15);
      scene.viewpoint = Viewpoint::looking_at({0.8 * std::sin(turn), -0.8 * std::cos(turn), 0.5}, {0.0, 0.3, 0.1});
      const std::size_t things = scene.things.size();
      scene.things.push_back(moved(test::box(4.0, 0.01, 3.0), {0.0, 0.6 + gap + 0.005, 0.0}));
      scene.things.push_back(moved(test::box(6.0, 6.0, 0.01), {0.0, 0.0, -0.7}));
      for (const SegmentSplit split : {SegmentSplit::none, SegmentSplit::concave}) {
        const Segmentation found = segmented(scene, split, 1.0);
        EXPECT_EQ(found.objects.size(), things) << "a gap of " << gap << " m, turned by " << turn;
        const std::vector<double> shares = agreement(scene, found);
        EXPECT_GT(std::min(shares[0], shares[1]), 0.8);
      }
    }
  }
}

TEST(Segment, GivesEachObjectItsBox) {
  Scene scene = two_boxes(0.15);
  const Segmentation found = segmented(scene, SegmentSplit::none);
  ASSERT_EQ(found.objects.size(), 2U);
  // Of the first the front and the top are seen: all of its footprint.
  const OrientedBox& box = found.objects[0].box;
  EXPECT_NEAR(box.size.x(), 0.12, 0.006);
  EXPECT_NEAR(box.size.y(), 0.1, 0.006);
  EXPECT_NEAR(box.size.z(), 0.15, 0.006);
  const Vec3 centre(-0.135, 0.0, 0.075);
  EXPECT_LT((box.centre - scene.viewpoint.to_camera(centre).cast<float>()).norm(), 0.006F);
  EXPECT_NEAR(box.axes.determinant(), 1.0F, 1e-5F);
  EXPECT_GT(box.axes.col(2).dot(scene.table().normal), 0.9999F);
  EXPECT_GT(std::abs(box.axes.col(0).dot((scene.viewpoint.axes * Vec3::UnitX()).cast<float>())), 0.999F);
}

TEST(Segment, TellsWhereTheTableEnds) {
  Scene scene;
  scene.table_half = 0.3;
  const Segmentation found = segmented(scene, SegmentSplit::none);
  ASSERT_GE(found.outline.size(), 4U);
  float widest = 0.0F;
  for (const Eigen::Vector3f& corner : found.outline) {
    EXPECT_NEAR(scene.table().height(corner), 0.0F, 1e-5F);
    widest = std::max(widest, (corner - found.outline[0]).norm());
  }
  EXPECT_NEAR(widest, 0.6 * std::numbers::sqrt2, 0.09);
}

TEST(Segment, SaysWhatIsTooHigh) {
  Scene scene;
  scene.viewpoint = Viewpoint::looking_at({0.0, -4.0, 2.0}, {0.0, 0.0, 0.6});
  scene.table_half = 1.5;
  scene.things = {moved(test::box(0.3, 0.3, 2.4), {0.0, 0.0, 1.2})};
  const Segmentation found = segmented(scene, SegmentSplit::none);
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_NEAR(found.objects[0].height, 2.0, 0.03);
  EXPECT_GT(found.left_out.too_high, 100U);
}

TEST(Segment, SaysThatThePictureCutsAnObject) {
  Scene scene;
  scene.things = {moved(test::box(0.3, 0.1, 0.1), {-0.55, 0.0, 0.05})};
  const Segmentation found = segmented(scene, SegmentSplit::none);
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_TRUE(found.objects[0].cut);
}

TEST(SegmentSettings, AreRefusedOutOfRange) {
  SegmentSettings settings;
  settings.least_area = -1.0F;
  EXPECT_NE(test::input_error([&] { settings.validate(); }).find("least area of objects -1 m2 is out of range"),
            std::string::npos);
  settings = {};
  settings.least_height = 2.0F;
  EXPECT_NE(test::input_error([&] { settings.validate(); }).find("out of range"), std::string::npos);
}

TEST(SegmentCloud, StandsUprightWithTheNormalsOfTheSides) {
  Scene scene;
  scene.things = {moved(test::box(0.2, 0.2, 0.1), {0.0, 0.0, 0.05})};
  const Segmentation found = segmented(scene, SegmentSplit::none);
  ASSERT_EQ(found.objects.size(), 1U);
  const PointCloud cloud = segment_cloud(scene.picture(), scene.intrinsics, scene.table(), found, found.objects[0]);
  ASSERT_EQ(cloud.points.size(), cloud.normals.size());
  EXPECT_GT(cloud.points.size(), 1950U);
  EXPECT_LE(cloud.points.size(), kMostCloudPoints);
  EXPECT_NEAR(cloud.sensor->z(), 0.7, 1e-6);
  std::size_t up = 0;
  std::size_t sideways = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_GT(cloud.points[i].z(), 0.0);
    EXPECT_LT(cloud.points[i].z(), 0.1001);
    EXPECT_NEAR(cloud.normals[i].norm(), 1.0, 1e-5);
    up += cloud.normals[i].z() > 0.999 ? 1 : 0;
    sideways += std::abs(cloud.normals[i].z()) < 0.02 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(up + sideways), 0.85 * static_cast<double>(cloud.points.size()));
  EXPECT_GT(up, 500U);
  EXPECT_GT(sideways, 250U);
}

}  // namespace
}  // namespace spincat
