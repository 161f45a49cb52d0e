#include "spincat/evaluate/test_forms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "spincat/evaluate/evaluate.h"
#include "spincat/prepare/normals.h"
#include "support/expect_error.h"
#include "support/shapes.h"

namespace spincat {
namespace {

using test::input_error;

TestOptions options_of(TestForm form) {
  TestOptions options;
  options.form = form;
  return options;
}

Mesh mesh_in(const Object& object, TestForm form, std::uint64_t seed = 1) {
  return std::get<Mesh>(in_test_form(object, options_of(form), seed));
}

PointCloud cloud_in(const Object& object, const TestOptions& options, std::uint64_t seed = 1) {
  return std::get<PointCloud>(in_test_form(object, options, seed));
}

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const Vec3& n : face_area_normals(mesh)) {
    area += n.norm();
  }
  return area;
}

using Place = std::tuple<double, double, double>;

std::set<Place> places_of(const std::vector<Vec3>& points) {
  std::set<Place> places;
  for (const Vec3& p : points) {
    places.insert({p.x(), p.y(), p.z()});
  }
  return places;
}

// The root of the mean square of all coordinates' differences.
double moved(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    squares += (a[i] - b[i]).squaredNorm();
  }
  return std::sqrt(squares / (3.0 * static_cast<double>(a.size())));
}

TEST(InTestForm, TurnsRigidly) {
  const Mesh box = test::box(1, 2, 3);
  const Mesh turned = mesh_in(box, TestForm::turned);
  EXPECT_EQ(turned.triangles, box.triangles);
  EXPECT_GT((turned.vertices[7] - box.vertices[7]).norm(), 0.01);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR((turned.vertices[i] - turned.vertices[j]).norm(), (box.vertices[i] - box.vertices[j]).norm(), 1e-12);
    }
  }
  EXPECT_NE(mesh_in(box, TestForm::turned, 2).vertices[7], turned.vertices[7]);
}

TEST(InTestForm, SamplesTheSurfaceWithNoise) {
  TestOptions options = options_of(TestForm::cloud);
  options.cloud_points = 500;
  options.noise = 0.0;
  const PointCloud on_surface = cloud_in(test::box(2, 2, 2), options);
  ASSERT_EQ(on_surface.points.size(), 500U);
  EXPECT_TRUE(on_surface.normals.empty());
  for (const Vec3& p : on_surface.points) {
    EXPECT_NEAR(p.cwiseAbs().maxCoeff(), 1.0, 1e-12);
  }
  options.noise = 0.01;
  const PointCloud noisy = cloud_in(test::box(2, 2, 2), options);
  // The diameter is nearly twice the root of three.
  EXPECT_NEAR(moved(noisy.points, on_surface.points), 0.02 * std::sqrt(3.0), 0.003);
}

TEST(InTestForm, ANoisyMeshHasItsVerticesMoved) {
  for (const double size : {1.0, 1e-6, 1e100}) {
    Mesh ball = test::scaled(test::icosphere(3), size);
    for (Vec3& v : ball.vertices) {
      v += size * Vec3(7, 8, 9);
    }
    const Mesh noisy = mesh_in(ball, TestForm::noisy_mesh);
    EXPECT_EQ(noisy.triangles, ball.triangles);
    EXPECT_NEAR(moved(noisy.vertices, ball.vertices) / size, 0.005 * 2.0, 0.0006) << size;
  }
}

TEST(InTestForm, VerticesAtOnePlaceMoveTogether) {
  const Mesh soup = test::soup_of(test::icosphere(1));
  for (const TestForm form : {TestForm::noisy_mesh, TestForm::dense_mesh}) {
    const Mesh noisy = mesh_in(soup, form);
    if (form == TestForm::noisy_mesh) {
      EXPECT_EQ(noisy.vertices.size(), soup.vertices.size());
      EXPECT_EQ(places_of(noisy.vertices).size(), 42U);
    } else {
      EXPECT_EQ(places_of(noisy.vertices).size(), noisy.vertices.size());
      EXPECT_EQ(noisy.triangles.size(), 2 * (noisy.vertices.size() - 2));  // closed: Euler's formula
    }
  }
}

TEST(InTestForm, ADenseMeshHasManyTrianglesNearTheSurface) {
  const Mesh box = test::box(2, 2, 2);
  const Mesh dense = mesh_in(box, TestForm::dense_mesh);
  EXPECT_GE(dense.triangles.size(), 8'000U);
  EXPECT_LT(dense.triangles.size(), 8'010U);
  double squares = 0.0;
  for (const Vec3& v : dense.vertices) {
    squares += std::pow(v.cwiseAbs().maxCoeff() - 1.0, 2);
  }
  const double off = std::sqrt(squares / static_cast<double>(dense.vertices.size()));
  EXPECT_NEAR(off, 0.02 * std::sqrt(3.0), 0.004);
  // What is dense already only gets noise.
  const Mesh ball = test::icosphere(5);
  EXPECT_EQ(mesh_in(ball, TestForm::dense_mesh).triangles, ball.triangles);
}

TEST(InTestForm, HolesAreAFifthOfTheAreaInPieces) {
  for (const Mesh& mesh : {test::box(1, 2, 3), test::icosphere(4), test::soup_of(test::box())}) {
    const Mesh holed = mesh_in(mesh, TestForm::holes);
    EXPECT_LE(area_of(holed), 0.8 * area_of(mesh));
    EXPECT_GT(area_of(holed), 0.79 * area_of(mesh));
    EXPECT_NE(holed.triangles, mesh_in(mesh, TestForm::holes, 2).triangles);
  }
  const Mesh holed = mesh_in(test::box(2, 2, 2), TestForm::holes);
  for (const Vec3& v : holed.vertices) {
    EXPECT_NEAR(v.cwiseAbs().maxCoeff(), 1.0, 1e-12);
  }
  for (const Triangle& t : holed.triangles) {
    EXPECT_LE((holed.vertices[t[0]] - holed.vertices[t[1]]).norm(), 0.1 * 2.0 * std::sqrt(3.0) + 1e-12);
  }
}

TEST(InTestForm, InnerPiecesAreInside) {
  const Mesh box = test::box(2, 4, 6);
  const Mesh filled = mesh_in(box, TestForm::inner);
  ASSERT_EQ(filled.vertices.size(), 8U + 30 * 8);
  ASSERT_EQ(filled.triangles.size(), 12U + 30 * 12);
  EXPECT_TRUE(std::equal(box.triangles.begin(), box.triangles.end(), filled.triangles.begin()));
  for (std::size_t v = 0; v < filled.vertices.size(); ++v) {
    const double reach = filled.vertices[v].cwiseQuotient(Vec3(1, 2, 3)).cwiseAbs().maxCoeff();
    if (v < 8) {
      EXPECT_NEAR(reach, 1.0, 1e-12);
    } else {
      EXPECT_LT(reach, 1.0);
    }
  }
  // Each piece is closed, and its faces look outwards: by Gauss its volume is a sum over them.
  for (std::size_t piece = 0; piece < 30; ++piece) {
    double volume = 0.0;
    for (std::size_t f = 12 + 12 * piece; f < 24 + 12 * piece; ++f) {
      const auto& [a, b, c] = filled.triangles[f];
      volume += filled.vertices[a].dot(filled.vertices[b].cross(filled.vertices[c])) / 6.0;
    }
    const Vec3 sizes = filled.vertices[8 + 8 * piece + 7] - filled.vertices[8 + 8 * piece];
    EXPECT_NEAR(volume, sizes.prod(), 1e-12);
    EXPECT_GT(volume, 0.0);
  }
}

TEST(InTestForm, WhatEnclosesNothingGetsNoInnerPieces) {
  Mesh open = test::box();
  open.triangles.resize(10);  // no top
  EXPECT_EQ(mesh_in(open, TestForm::inner).triangles, open.triangles);
}

TEST(InTestForm, ACutCloudEndsAtAPlane) {
  const PointCloud whole = cloud_in(test::icosphere(3), options_of(TestForm::cut));
  EXPECT_EQ(whole.points.size(), 1434U);  // 70 % of 2,048
  TestOptions options = options_of(TestForm::cloud);
  options.noise = 0.0;
  const PointCloud all = cloud_in(test::icosphere(3), options);
  const std::set<Place> kept = places_of(whole.points);
  Vec3 missing = Vec3::Zero();
  for (const Vec3& p : all.points) {
    missing += kept.contains({p.x(), p.y(), p.z()}) ? Vec3(0, 0, 0) : p;
  }
  const Vec3 direction = missing.normalized();  // of a ball: roughly where the plane is
  std::size_t beyond = 0;
  for (const Vec3& p : whole.points) {
    beyond += p.dot(direction) > 0.5 ? 1 : 0;  // a cap of 30 % of the area ends at a height of .4
  }
  EXPECT_EQ(beyond, 0U);
}

TEST(InTestForm, ASparseCloudIsAPartOfACloud) {
  EXPECT_EQ(cloud_in(test::box(), options_of(TestForm::sparse)).points.size(), 300U);
  const PointCloud given{test::sphere_points(1'000), {}, Vec3(0, 0, 9)};
  const PointCloud few = cloud_in(given, options_of(TestForm::sparse));
  EXPECT_EQ(few.points.size(), 300U);
  EXPECT_EQ(few.sensor, given.sensor);
  const std::set<Place> all = places_of(given.points);
  EXPECT_TRUE(std::ranges::includes(all, places_of(few.points)));
  EXPECT_EQ(places_of(few.points).size(), 300U);
}

TEST(InTestForm, IsTheSameForTheSameSeedAlone) {
  const Mesh mesh = test::cylinder(12, 1.0, 0.5, 3.0);
  const auto points = [&](TestForm form, std::uint64_t seed) {
    const Object object = in_test_form(mesh, options_of(form), seed);
    const Mesh* const shape = std::get_if<Mesh>(&object);
    return shape != nullptr ? shape->vertices : std::get<PointCloud>(object).points;
  };
  for (const TestForm form : {TestForm::turned, TestForm::cloud, TestForm::noisy_mesh, TestForm::dense_mesh,
                              TestForm::inner, TestForm::cut, TestForm::sparse}) {
    EXPECT_EQ(points(form, 1), points(form, 1)) << name_of(form);
    EXPECT_NE(points(form, 1), points(form, 2)) << name_of(form);
  }
  EXPECT_EQ(mesh_in(mesh, TestForm::holes).triangles, mesh_in(mesh, TestForm::holes).triangles);
}

TEST(InTestForm, WhatCannotBeMadeIsRefused) {
  const Mesh flat{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}};
  const auto error = [&](const Object& object, TestForm form) {
    return input_error([&] { in_test_form(object, options_of(form), 1); });
  };
  EXPECT_EQ(error(flat, TestForm::cloud), "has no area to draw a cloud's points from");
  EXPECT_EQ(error(flat, TestForm::dense_mesh), "has no area");
  EXPECT_EQ(error(flat, TestForm::holes), "has no area");
  EXPECT_EQ(error(flat, TestForm::inner), "has no area");
  EXPECT_EQ(error(Mesh{}, TestForm::noisy_mesh), "holds no points");
  const PointCloud cloud{test::sphere_points(10), {}, {}};
  EXPECT_EQ(error(cloud, TestForm::holes), "is a cloud: only meshes have holes and inner faces");
  EXPECT_EQ(error(cloud, TestForm::inner), "is a cloud: only meshes have holes and inner faces");
  EXPECT_EQ(cloud_in(cloud, options_of(TestForm::noisy_mesh)).points.size(), 10U);
}

TEST(TestOptions, EachFormHasItsOwn) {
  EXPECT_EQ(options_of(TestForm::cloud).used_noise(), 0.01);
  EXPECT_EQ(options_of(TestForm::noisy_mesh).used_noise(), 0.005);
  EXPECT_EQ(options_of(TestForm::sparse).used_noise(), 0.0);
  EXPECT_EQ(options_of(TestForm::cut).used_cloud_points(), 2048);
  EXPECT_EQ(options_of(TestForm::sparse).used_cloud_points(), 300);
  TestOptions options = options_of(TestForm::sparse);
  options.noise = 0.02;
  options.cloud_points = 100;
  EXPECT_EQ(options.used_noise(), 0.02);
  EXPECT_EQ(options.used_cloud_points(), 100);
}

TEST(TestOptions, FormsHaveNames) {
  for (int k = 0; k <= static_cast<int>(TestForm::sparse); ++k) {
    const auto form = static_cast<TestForm>(k);
    EXPECT_EQ(test_form_named(name_of(form)), form);
  }
  EXPECT_EQ(name_of(TestForm::noisy_mesh), "noisy-mesh");
  EXPECT_EQ(
      input_error([] { test_form_named("pudding"); }),
      "form 'pudding' is not known (one of as-is, turned, cloud, noisy-mesh, dense-mesh, holes, inner, cut, sparse)");
}

TEST(TestOptions, OutOfRangeAreRefused) {
  TestOptions options;
  options.noise = std::nan("");
  EXPECT_EQ(input_error([&] { options.validate(); }), "noise nan is out of range (0 to 1)");
  options = {};
  options.cloud_points = 0;
  EXPECT_EQ(input_error([&] { options.validate(); }), "number of cloud points 0 is out of range (1 to 10000000)");
}

}  // namespace
}  // namespace spincat
