#include "spincat/camera/render/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spincat/camera/render/sensor_noise.h"
#include "support/scenes.h"

namespace spincat {
namespace {

TEST(DrawDepth, GivesTheDepthOfAPlaneAtEveryPixel) {
  const test::Scene scene;
  const DepthImage image = scene.picture();
  const SupportPlane table = scene.table();
  std::size_t seen = 0;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      if (const float z = image.at(u, v); z > 0.0F) {
        EXPECT_NEAR(table.height(scene.intrinsics.point(u, v, z)), 0.0F, 1e-5F);
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 100'000U);
}

TEST(DrawDepth, ShowsASphereWhereRaysMeetIt) {
  Mesh ball = test::icosphere(6);
  for (Vec3& v : ball.vertices) {
    v = 0.2 * v + Vec3(0.1, 0.0, 1.0);
  }
  DepthImage image(640, 480);
  const Intrinsics intrinsics;
  draw_depth(ball, intrinsics, image);
  const auto depth_at = [](double x, double y) {  // of the ray (x, y, 1) t: |(x, y, 1) t - c| = r
    const double a = x * x + y * y + 1.0;
    const double b = 0.1 * x + 1.0;
    const double root = b * b - a * (1.01 - 0.04);
    return root < 0.0 ? 0.0 : (b - std::sqrt(root)) / a;
  };
  for (int v = 0; v < image.height; v += 7) {
    for (int u = 0; u < image.width; u += 7) {
      const double expected = depth_at((u - intrinsics.cx) / intrinsics.fx, (v - intrinsics.cy) / intrinsics.fy);
      if (expected > 0.0 && expected < 0.9) {  // not at the rim, where facets count
        EXPECT_NEAR(image.at(u, v), expected, 2e-4) << u << ", " << v;
      } else if (expected == 0.0) {
        EXPECT_EQ(image.at(u, v), 0.0F);
      }
    }
  }
}

TEST(DrawDepth, LeavesNoCrackBetweenTriangles) {
  // A fan of thin triangles that covers the picture.
  Mesh fan{{{0.013, 0.007, 1.0}}, {}};
  constexpr std::uint32_t kRim = 997;
  for (std::uint32_t k = 0; k < kRim; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / kRim;
    fan.vertices.emplace_back(5.0 * std::cos(angle), 5.0 * std::sin(angle), 1.0);
    fan.triangles.push_back({0, k + 1, (k + 1) % kRim + 1});
  }
  DepthImage image(640, 480);
  draw_depth(fan, {}, image);
  for (const float z : image.depth) {
    ASSERT_NEAR(z, 1.0F, 1e-6F);
  }
}

TEST(DrawDepth, CutsOffWhatLiesBehindTheCamera) {
  // A floor from 2 m behind the camera to 4 m before it, half a metre below.
  const Mesh floor{{{-1, 0.5, -2}, {1, 0.5, -2}, {1, 0.5, 4}, {-1, 0.5, 4}}, {{0, 1, 2}, {0, 2, 3}}};
  DepthImage image(640, 480);
  const Intrinsics intrinsics;
  draw_depth(floor, intrinsics, image);
  EXPECT_EQ(image.at(320, 200), 0.0F);
  EXPECT_NEAR(image.at(320, 479), 0.5 / ((479 - intrinsics.cy) / intrinsics.fy), 1e-5);
}

// Root mean square of a wall's readings about its depth.
double scatter(double z, double strength) {
  DepthImage image(200, 200);
  std::ranges::fill(image.depth, static_cast<float>(z));
  Random random(3);
  add_sensor_noise({525.0, 525.0, 100.0, 100.0}, strength, random, image);
  double squares = 0.0;
  int count = 0;
  for (int v = 2; v < 198; ++v) {
    for (int u = 2; u < 198; ++u) {
      squares += std::pow(image.at(u, v) - z, 2.0);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

TEST(SensorNoise, IsThatOfAKinect) {
  EXPECT_NEAR(scatter(0.7, 1.0), 0.0010, 0.0003);
  EXPECT_NEAR(scatter(1.35, 1.0), 0.0037, 0.0008);
  EXPECT_LT(scatter(0.7, 0.3), scatter(0.7, 1.0));
}

TEST(SensorNoise, LosesReadingsAtEdgesOnly) {
  DepthImage image(100, 100);
  for (int v = 0; v < 100; ++v) {
    for (int u = 0; u < 100; ++u) {
      image.depth[image.index(u, v)] = u < 50 ? 0.8F : 1.2F;
    }
  }
  Random random(4);
  add_sensor_noise({}, 1.0, random, image);
  int lost = 0;
  for (int v = 0; v < 100; ++v) {
    for (int u = 0; u < 100; ++u) {
      const bool read = image.at(u, v) > 0.0F;
      EXPECT_TRUE(read || u == 49 || u == 50);
      lost += read ? 0 : 1;
    }
  }
  EXPECT_GT(lost, 60);
  EXPECT_LT(lost, 140);
}

TEST(SensorNoise, IsTheSameForTheSameSeed) {
  const DepthImage clean = test::Scene{}.picture();
  const auto noisy = [&](std::uint64_t seed) {
    DepthImage image = clean;
    Random random(seed);
    add_sensor_noise({}, 1.0, random, image);
    return image.depth;
  };
  EXPECT_EQ(noisy(1), noisy(1));
  EXPECT_NE(noisy(1), noisy(2));
}

}  // namespace
}  // namespace spincat
