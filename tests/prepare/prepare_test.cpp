#include "spincat/prepare/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "spincat/geometry/random.h"
#include "support/expect_error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using test::input_error;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PrepareSettings settings_of(SurfaceKind surface) {
  PrepareSettings settings;
  settings.surface = surface;
  return settings;
}

// Every number of an oriented point.
using Point = std::tuple<float, float, float, float, float, float>;

Point point(const OrientedPoints& points, std::size_t i) {
  return {points.x()[i], points.y()[i], points.z()[i], points.nx()[i], points.ny()[i], points.nz()[i]};
}

std::vector<Point> all_of(const OrientedPoints& points) {
  std::vector<Point> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.push_back(point(points, i));
  }
  return all;
}

// What holds of whatever was prepared.
void expect_sound(const PreparedObject& prepared) {
  ASSERT_FALSE(prepared.surface.empty());
  ASSERT_FALSE(prepared.spin_points.empty());
  Eigen::Vector3f low = prepared.surface.position(0);
  Eigen::Vector3f high = low;
  float furthest = 0.0F;
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    const Eigen::Vector3f p = prepared.surface.position(i);
    ASSERT_TRUE(p.allFinite());
    ASSERT_NEAR(prepared.surface.normal(i).norm(), 1.0F, 1e-6F);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    furthest = std::max(furthest, p.norm());
  }
  EXPECT_NEAR((low + high).norm(), 0.0F, 1e-6F);
  EXPECT_NEAR(furthest, 1.0F, 1e-6F);
  EXPECT_TRUE(std::isfinite(prepared.scale));
  EXPECT_GT(prepared.scale, 0.0);
  const std::vector<Point> surface = all_of(prepared.surface);
  const std::set<Point> known(surface.begin(), surface.end());
  for (const Point& spin_point : all_of(prepared.spin_points)) {
    EXPECT_TRUE(known.contains(spin_point)) << "a spin point is no point of the surface";
  }
}

void expect_same(const PreparedObject& a, const PreparedObject& b) {
  EXPECT_EQ(all_of(a.surface), all_of(b.surface));
  EXPECT_EQ(all_of(a.spin_points), all_of(b.spin_points));
}

class PrepareSurface : public testing::TestWithParam<SurfaceKind> {};

TEST_P(PrepareSurface, OfAMeshIsSoundAndRepeatable) {
  const Object object = test::icosphere(2);
  const PreparedObject prepared = prepare(object, settings_of(GetParam()), 1);
  expect_sound(prepared);
  EXPECT_EQ(prepared.spin_points.size(), 256U);
  expect_same(prepared, prepare(object, settings_of(GetParam()), 1));
  EXPECT_NE(all_of(prepared.spin_points), all_of(prepare(object, settings_of(GetParam()), 2).spin_points));
}

TEST_P(PrepareSurface, DoesNotDependOnTheUnit) {
  // Powers of two: no rounding differs.
  const Mesh mesh = test::cylinder(12, 1.0, 0.5, 3.0);
  const PreparedObject prepared = prepare(mesh, settings_of(GetParam()), 1);
  for (const double unit : {0x1p-100, 0x1p-10, 2.0, 0x1p100}) {
    const PreparedObject other = prepare(test::scaled(mesh, unit), settings_of(GetParam()), 1);
    expect_same(prepared, other);
    EXPECT_EQ(other.scale * unit, prepared.scale);
  }
}

TEST_P(PrepareSurface, IgnoresUnusedVerticesAndAddedFacesWithoutArea) {
  const Mesh mesh = test::cylinder(12, 1.0, 0.5, 3.0);
  Mesh other = mesh;
  other.vertices.emplace_back(1e30, -1e30, 1e30);
  const PreparedObject prepared = prepare(mesh, settings_of(GetParam()), 1);
  expect_same(prepared, prepare(other, settings_of(GetParam()), 1));
  other.triangles.push_back({0, 0, 1});
  expect_same(prepared, prepare(other, settings_of(GetParam()), 1));
}

TEST_P(PrepareSurface, OfTwoTrianglesIsDefined) {
  const Mesh table{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const PreparedObject prepared = prepare(table, settings_of(GetParam()), 1);
  expect_sound(prepared);
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    EXPECT_NEAR(std::abs(prepared.surface.normal(i).z()), 1.0F, 1e-6F);
  }
}

TEST_P(PrepareSurface, OfANeedleIsDefined) {
  // Far thinner than a pixel of the z-buffer.
  const Mesh needle{{{0, 0, 0}, {1, 0, 0}, {0, 1e-9, 0}}, {{0, 1, 2}}};
  const PreparedObject prepared = prepare(needle, settings_of(GetParam()), 1);
  expect_sound(prepared);
  EXPECT_EQ(prepared.surface.size(), GetParam() == SurfaceKind::vertices ? 3U : 2048U);
}

TEST_P(PrepareSurface, OfFlatFacesIsTheCloudOfTheirVertices) {
  // All faces have lost their area; of the second mesh they have lost their length, too.
  std::vector<Vec3> points = test::sphere_points(100);
  for (const Triangle& triangle : {Triangle{5, 5, 7}, Triangle{5, 5, 5}}) {
    const PreparedObject prepared = prepare(Mesh{points, {triangle}}, settings_of(GetParam()), 1);
    expect_sound(prepared);
    expect_same(prepared, prepare(PointCloud{points, {}, {}}, settings_of(GetParam()), 1));
  }
}

TEST_P(PrepareSurface, OfAMeshWithoutFacesIsTheCloudOfItsVertices) {
  const std::vector<Vec3> points = test::sphere_points(100);
  expect_same(prepare(Mesh{points, {}}, settings_of(GetParam()), 1),
              prepare(PointCloud{points, {}, {}}, settings_of(GetParam()), 1));
}

TEST_P(PrepareSurface, OfFivePointsIsDefined) {
  const PointCloud cloud{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 3, 3}}, {}, {}};
  const PreparedObject prepared = prepare(cloud, settings_of(GetParam()), 1);
  expect_sound(prepared);
  EXPECT_EQ(prepared.surface.size(), 5U);
  EXPECT_EQ(prepared.spin_points.size(), GetParam() == SurfaceKind::vertices ? 256U : 5U);
}

TEST_P(PrepareSurface, ARepeatedPointOfACloudCountsOnce) {
  PointCloud cloud{test::sphere_points(50), {}, {}};
  const PreparedObject prepared = prepare(cloud, settings_of(GetParam()), 1);
  cloud.points.insert(cloud.points.end(), 10'000, cloud.points[7]);
  expect_same(prepared, prepare(cloud, settings_of(GetParam()), 1));
}

TEST_P(PrepareSurface, OfWhatHasNoExtentIsRefused) {
  const PrepareSettings settings = settings_of(GetParam());
  const std::vector<Vec3> same(10, Vec3(1, 2, 3));
  EXPECT_EQ(input_error([&] { prepare(PointCloud{same, {}, {}}, settings, 1); }), "all its points are at one place");
  EXPECT_EQ(input_error([&] { prepare(Mesh{same, {{0, 1, 2}}}, settings, 1); }), "all its points are at one place");
  EXPECT_EQ(input_error([&] { prepare(Mesh{same, {}}, settings, 1); }), "all its points are at one place");
  EXPECT_EQ(input_error([&] {
              prepare(PointCloud{{{1, 2, 3}}, {}, {}}, settings, 1);
            }),
            "all its points are at one place");
  EXPECT_EQ(input_error([&] { prepare(PointCloud{}, settings, 1); }), "holds no points");
  EXPECT_EQ(input_error([&] { prepare(Mesh{}, settings, 1); }), "holds no points");
}

INSTANTIATE_TEST_SUITE_P(Surfaces, PrepareSurface,
                         testing::Values(SurfaceKind::vertices, SurfaceKind::samples, SurfaceKind::external));

TEST(Prepare, VerticesAreTheVerticesWithTheirNormals) {
  const PreparedObject prepared = prepare(test::box(1, 2, 2), settings_of(SurfaceKind::vertices), 1);
  ASSERT_EQ(prepared.surface.size(), 8U);
  EXPECT_NEAR((prepared.surface.position(7) - Eigen::Vector3f(1, 2, 2) / 3.0F).norm(), 0.0F, 1e-6F);
  EXPECT_DOUBLE_EQ(prepared.scale, 2.0 / 3.0);
}

TEST(Prepare, FewVerticesAreRepeatedAsSpinPointsInTurn) {
  PrepareSettings settings = settings_of(SurfaceKind::vertices);
  settings.spin_points = 20;
  const std::vector<Point> spin_points = all_of(prepare(test::box(), settings, 1).spin_points);
  ASSERT_EQ(spin_points.size(), 20U);
  EXPECT_EQ(std::set<Point>(spin_points.begin(), spin_points.begin() + 8).size(), 8U);
  for (std::size_t k = 8; k < 20; ++k) {
    EXPECT_EQ(spin_points[k], spin_points[k - 8]);
  }
}

TEST(Prepare, SpinPointsAreTheFirstOfTheSurfaceDraw) {
  PrepareSettings settings = settings_of(SurfaceKind::external);
  settings.points = 300;
  settings.spin_points = 400;
  const PreparedObject prepared = prepare(test::box(), settings, 1);
  EXPECT_EQ(prepared.surface.size(), 300U);
  EXPECT_EQ(all_of(prepared.surface), all_of(prepared.spin_points));
}

class PrepareOrientation : public testing::TestWithParam<SurfaceKind> {};

TEST_P(PrepareOrientation, OutwardMendsFlippedFaces) {
  // Turned as a whole: where each vertex has faces of one side only, there is no doubt about its line.
  Mesh mesh = test::icosphere(2);
  for (Triangle& t : mesh.triangles) {
    std::swap(t[0], t[1]);
  }
  PrepareSettings settings = settings_of(GetParam());
  const auto outward = [&] {
    const PreparedObject prepared = prepare(mesh, settings, 1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
      count += prepared.surface.normal(i).dot(prepared.surface.position(i)) > 0.0F ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(prepared.surface.size());
  };
  settings.orientation = NormalOrientation::outward;
  EXPECT_EQ(outward(), 1.0);
  settings.orientation = NormalOrientation::as_given;
  EXPECT_EQ(outward(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, PrepareOrientation, testing::Values(SurfaceKind::vertices, SurfaceKind::samples));

TEST(PrepareCloud, KeepsGivenNormalsWhateverTheirLength) {
  PointCloud cloud{test::sphere_points(60), {}, {}};
  for (const double length : {1.0, 1e-200, 1e200}) {
    cloud.normals.clear();
    for (const Vec3& p : cloud.points) {
      cloud.normals.emplace_back(-length * p);  // inwards: as given, not turned
    }
    const PreparedObject prepared = prepare(cloud, PrepareSettings{}, 1);
    expect_sound(prepared);
    float most = -1.0F;
    for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
      most = std::max(most, prepared.surface.normal(i).dot(prepared.surface.position(i)));
    }
    EXPECT_LT(most, -0.9F) << "normals of length " << length;
  }
}

TEST(PrepareCloud, EstimatesNormalsWhereNotAllAreKnown) {
  PointCloud cloud{test::sphere_points(60), {}, {}};
  const PreparedObject estimated = prepare(cloud, PrepareSettings{}, 1);
  for (const Vec3& unknown : {Vec3(0, 0, 0), Vec3(kNaN, 0, 1), Vec3(0, std::numeric_limits<double>::infinity(), 0)}) {
    cloud.normals.assign(60, Vec3(0, 0, 1));
    cloud.normals[30] = unknown;
    expect_same(prepare(cloud, PrepareSettings{}, 1), estimated);
  }
}

TEST(PrepareCloud, EstimatedNormalsTurnOutwardsOrToTheSensor) {
  PointCloud cloud{test::sphere_points(500), {}, {}};
  const PreparedObject outward = prepare(cloud, PrepareSettings{}, 1);
  cloud.sensor = Vec3(0, 0, 0);
  const PreparedObject inward = prepare(cloud, PrepareSettings{}, 1);
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_GT(outward.surface.normal(i).dot(outward.surface.position(i)), 0.9F);
    EXPECT_LT(inward.surface.normal(i).dot(inward.surface.position(i)), -0.9F);
  }
}

// 50,000 points of a ball with noise of 1 % of its radius. A normal of a plane through k neighbours within r is off by
// about noise / (r sqrt(k) / 2): 0.09 among all points, 0.04 among the 8,192 of which 2,048 are drawn.
TEST(PrepareCloud, OfADenseCloudNormalsLookFurtherThanNoise) {
  Random random(12);
  PointCloud ball;
  for (int i = 0; i < 50'000; ++i) {
    const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    ball.points.push_back(direction * (1.0 + 0.01 * random.normal()));
  }
  const PreparedObject prepared = prepare(ball, {}, 5);
  ASSERT_EQ(prepared.surface.size(), 2048U);
  double sum = 0.0;
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    sum += std::acos(std::min(1.0F, prepared.surface.normal(i).dot(prepared.surface.position(i).normalized())));
  }
  EXPECT_LT(sum / 2048.0, 0.065);
  EXPECT_EQ(prepare(ball, {}, 5).surface.position(7), prepared.surface.position(7));
}

TEST(PrepareSettings, AreRefusedOutOfRange) {
  const auto error = [](int PrepareSettings::*field, int value) {
    PrepareSettings settings;
    settings.*field = value;
    return input_error([&] { prepare(test::box(), settings, 1); });
  };
  EXPECT_EQ(error(&PrepareSettings::points, 0), "points 0: expected 1 to 10,000,000");
  EXPECT_EQ(error(&PrepareSettings::points, 10'000'001), "points 10000001: expected 1 to 10,000,000");
  EXPECT_EQ(error(&PrepareSettings::spin_points, -5), "spin_points -5: expected 1 to 10,000,000");
  EXPECT_EQ(error(&PrepareSettings::neighbours, 2), "neighbours 2: expected 3 to 1,000");
  EXPECT_EQ(error(&PrepareSettings::neighbours, 1001), "neighbours 1001: expected 3 to 1,000");
}

TEST(StretchedCopy, StretchesEachAxisWithinTheAmount) {
  const Mesh mesh = test::box(2, 2, 2);
  std::set<std::tuple<double, double, double>> seen;
  for (int copy = 1; copy <= 20; ++copy) {
    const Mesh stretched = std::get<Mesh>(stretched_copy(mesh, copy, 0.2, 1));
    const Vec3 factors = stretched.vertices[7];
    EXPECT_LE(factors.array().log().abs().maxCoeff(), 0.2);
    seen.insert({factors.x(), factors.y(), factors.z()});
    for (std::size_t v = 0; v < 8; ++v) {
      EXPECT_EQ(stretched.vertices[v], mesh.vertices[v].cwiseProduct(factors));
    }
  }
  EXPECT_EQ(seen.size(), 20U);
}

TEST(StretchedCopy, IsRepeatableAndDiffersBySeed) {
  const Object object = test::box();
  const auto corner = [&](std::uint64_t seed) {
    return std::get<Mesh>(stretched_copy(object, 1, 0.2, seed)).vertices[7];
  };
  EXPECT_EQ(corner(1), corner(1));
  EXPECT_NE(corner(1), corner(2));
  EXPECT_EQ(std::get<Mesh>(stretched_copy(object, 1, 0.0, 1)).vertices, test::box().vertices);
}

double worst_angle_to_radius(const OrientedPoints& points) {
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cosine = points.position(i).normalized().dot(points.normal(i));
    worst = std::max(worst, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
  }
  return worst;
}

TEST(Prepare, FillsThinCloudsUp) {
  const PreparedObject prepared = prepare(PointCloud{test::sphere_points(300), {}, {}}, PrepareSettings{}, 1);
  EXPECT_GT(prepared.surface.size(), 1500U);
  EXPECT_LT(worst_angle_to_radius(prepared.surface), 15.0);
  EXPECT_EQ(prepared.spin_points.size(), 256U);
}

TEST(Prepare, LeavesOutPointsThatNobodySees) {
  std::vector<Vec3> points = test::sphere_points(2000);
  for (const Vec3& p : test::sphere_points(300)) {
    points.emplace_back(0.5 * p);
  }
  const PreparedObject prepared = prepare(PointCloud{points, {}, {}}, PrepareSettings{}, 1);
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    EXPECT_GT(prepared.surface.position(i).norm(), 0.9F);
  }
}

TEST(Prepare, SeesBothSidesOfAThinBoard) {
  std::vector<Vec3> board;
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 40; ++k) {
      board.emplace_back(0.05 * i, 0.05 * k, 0.0);
    }
  }
  const PreparedObject prepared = prepare(PointCloud{board, {}, {}}, PrepareSettings{}, 1);
  std::size_t up = 0;
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    EXPECT_GT(std::abs(prepared.surface.normal(i).z()), 0.99F);
    up += prepared.surface.normal(i).z() > 0.0F ? 1U : 0U;
  }
  EXPECT_NEAR(static_cast<double>(up) / static_cast<double>(prepared.surface.size()), 0.5, 0.1);
}

TEST(Prepare, TakesNormalsOfARoughMeshFromTheNeighbours) {
  Mesh mesh = test::icosphere(4);
  Random random(1);
  for (Vec3& v : mesh.vertices) {
    v *= 1.0 + 0.02 * random.normal();
  }
  const PreparedObject prepared = prepare(mesh, PrepareSettings{}, 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
    sum += prepared.surface.position(i).normalized().dot(prepared.surface.normal(i));
  }
  EXPECT_GT(sum / static_cast<double>(prepared.surface.size()), 0.97);  // of the faces' own normals: less than .9
}

// That each surface and spin point of the paper's surface is the point of the file that its row says.
void expect_rows(const Object& object, const std::vector<Vec3>& file, const std::vector<std::uint32_t>& rows) {
  PrepareSettings settings = settings_of(SurfaceKind::vertices);
  settings.spin_points = 50;
  const PreparedObject prepared = prepare(object, settings, 1);
  EXPECT_EQ(prepared.surface_rows, rows);
  const auto is_at = [&](const OrientedPoints& points, std::size_t i, std::uint32_t row) {
    return (points.position(i).cast<double>() / prepared.scale + prepared.centre - file[row]).norm() < 1e-6;
  };
  ASSERT_EQ(prepared.surface.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_TRUE(is_at(prepared.surface, i, rows[i])) << i;
  }
  ASSERT_EQ(prepared.spin_rows.size(), 50U);
  for (std::size_t k = 0; k < 50; ++k) {
    ASSERT_TRUE(is_at(prepared.spin_points, k, prepared.spin_rows[k])) << k;
  }
}

TEST(Prepare, TellsWhichPointsOfTheFileItTook) {
  std::vector<Vec3> points = test::sphere_points(300);
  points[10] = points[4];
  points[20] = Vec3(40, 0, 0);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < 300; ++i) {
    if (i != 10 && i != 20) {
      rows.push_back(i);
    }
  }
  expect_rows(PointCloud{points, {}, {}}, points, rows);
  expect_rows(Mesh{points, {}}, points, rows);  // without a face, as a cloud

  Mesh box = test::box();
  box.vertices.insert(box.vertices.begin(), Vec3(7, 7, 7));  // of no face
  for (Triangle& triangle : box.triangles) {
    for (std::uint32_t& corner : triangle) {
      ++corner;
    }
  }
  const auto first = static_cast<std::uint32_t>(box.vertices.size());
  for (const Vec3& corner : {Vec3(90, 90, 90), Vec3(90.001, 90, 90), Vec3(90, 90.001, 90)}) {
    box.vertices.push_back(corner);  // of a speck of dust
  }
  box.triangles.push_back({first, first + 1, first + 2});
  rows.clear();
  for (std::uint32_t i = 1; i < first; ++i) {
    rows.push_back(i);
  }
  expect_rows(box, box.vertices, rows);
}

TEST(Prepare, TellsOfNoPointsWhereItDrewThem) {
  for (const SurfaceKind surface : {SurfaceKind::samples, SurfaceKind::external}) {
    const PreparedObject prepared = prepare(test::box(), settings_of(surface), 1);
    EXPECT_TRUE(prepared.surface_rows.empty());
    EXPECT_TRUE(prepared.spin_rows.empty());
  }
}

}  // namespace
}  // namespace spincat
