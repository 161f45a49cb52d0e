#include "spincat/camera/render/views.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/expect_error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using test::input_error;

TEST(ViewOf, StandsUprightAndIsSeenFromOneSide) {
  ViewSettings settings;
  settings.up = UpAxis::y;
  const Mesh tower = test::box(1.0, 4.0, 1.0);  // y is up in its file
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PointCloud view = view_of(tower, settings, seed);
    double height = 0.0;
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      height = std::max(height, view.points[i].z());
      EXPECT_GT((*view.sensor - view.points[i]).dot(view.normals[i]), 0.0);
    }
    EXPECT_GT(height, 0.145);
    EXPECT_LT(height, 0.36);
    const auto [low, high] = std::ranges::minmax(view.points, {}, [](const Vec3& p) { return p.x(); });
    EXPECT_LT(high.x() - low.x(), 0.5 * height);  // four times as high as wide
  }
}

TEST(ViewOf, DependsOnTheSeedAlone) {
  const Mesh model = test::cylinder(24, 1.0, 0.5, 2.0);
  const PointCloud a = view_of(model, {}, 5);
  EXPECT_EQ(a.points, view_of(model, {}, 5).points);
  EXPECT_EQ(a.points, view_of(model, {}, 5).points);
  EXPECT_NE(a.points, view_of(model, {}, 6).points);
}

TEST(ViewOf, DoesNotDependOnTheUnitOfTheFile) {
  const Mesh model = test::box(1.0, 2.0, 1.5);
  Mesh large = model;
  for (Vec3& v : large.vertices) {
    v = v * 0x1p40 + Vec3(0x1p42, 0, 0);
  }
  EXPECT_EQ(view_of(model, {}, 1).points.size(), view_of(large, {}, 1).points.size());
}

TEST(ViewOf, RefusesWhatShowsNothing) {
  EXPECT_EQ(input_error([] { view_of(Mesh{}, {}, 1); }), "holds no points");
  EXPECT_EQ(input_error([] { view_of(Mesh{{{1, 1, 1}}, {}}, {}, 1); }), "all its points are at one place");
  const Mesh wire{{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  EXPECT_NE(input_error([&] { view_of(wire, {}, 1); }).find("too little"), std::string::npos);
}

TEST(ViewSettings, AreRefusedOutOfRange) {
  ViewSettings settings;
  settings.most_distance = 0.5;
  EXPECT_NE(input_error([&] { settings.validate(); }).find("distance of views"), std::string::npos);
}

}  // namespace
}  // namespace spincat
