// Organized clouds whose axes point one way or another.
#include "spincat/camera/source/cloud_frame.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "support/expect_error.h"

namespace spincat {
namespace {

using test::input_error;

constexpr Intrinsics kCamera{50.0, 60.0, 9.0, 7.0};

// A tilted plane with holes, each point turned as told.
OrganizedCloud plane(const std::function<Vec3(const Vec3&)>& turned) {
  OrganizedCloud cloud{20, 16, {}};
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      const Vec3 p = kCamera.point(u, v, 1.0F + 0.01F * static_cast<float>(u)).cast<double>();
      cloud.points.push_back((u + v) % 5 == 0 ? Vec3(kNone, kNone, kNone) : turned(p));
    }
  }
  return cloud;
}

void expect_the_picture(const Frame& frame) {
  EXPECT_NEAR(frame.intrinsics.fx, kCamera.fx, 1e-3);
  EXPECT_NEAR(frame.intrinsics.fy, kCamera.fy, 1e-3);
  EXPECT_NEAR(frame.intrinsics.cx, kCamera.cx, 1e-3);
  EXPECT_NEAR(frame.intrinsics.cy, kCamera.cy, 1e-3);
  EXPECT_NEAR(frame.image.at(3, 1), 1.03F, 1e-5F);
  EXPECT_EQ(frame.image.at(0, 0), 0.0F);
}

TEST(CloudFrame, IsTheSameWhereverAxesPoint) {
  expect_the_picture(frame_of_cloud(plane([](const Vec3& p) { return p; })));
  expect_the_picture(frame_of_cloud(plane([](const Vec3& p) { return Vec3(p.x(), -p.y(), -p.z()); })));  // y up, z back
  expect_the_picture(frame_of_cloud(plane([](const Vec3& p) { return Vec3(-p.x(), p.y(), -p.z()); })));
  expect_the_picture(frame_of_cloud(plane([](const Vec3& p) { return Vec3(-p.x(), -p.y(), p.z()); })));
  expect_the_picture(frame_of_cloud(plane([](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); })));  // y up
}

TEST(CloudFrame, PassesOverAFewPointsBehindTheCamera) {
  OrganizedCloud cloud = plane([](const Vec3& p) { return p; });
  cloud.points[2] = Vec3(0.1, 0.1, -1.0);
  cloud.points[3] = Vec3(0.0, 0.0, 0.0);
  const Frame frame = frame_of_cloud(cloud);
  expect_the_picture(frame);
  EXPECT_EQ(frame.image.at(2, 0), 0.0F);
  EXPECT_EQ(frame.image.at(3, 0), 0.0F);
}

TEST(CloudFrame, NamesTheAxesOfWhatIsNoPicture) {
  const auto error_of = [](const std::function<Vec3(const Vec3&)>& turned) {
    return input_error([&] { frame_of_cloud(plane(turned)); });
  };
  // A robot's: x forward, y left, z up.
  EXPECT_EQ(
      error_of([](const Vec3& p) { return Vec3(p.z(), -p.x(), -p.y()); }),
      "z is negative for 128 of its points and positive for 112: expected x right, y down, z forward, or y up and z "
      "backward");
  EXPECT_EQ(
      error_of([](const Vec3& p) { return Vec3(p.z(), -p.x(), -p.y() - 5.0); }),
      "is not what a camera sees along z (y / z does not follow the pixels): expected x right, y down, z forward, or "
      "y up and z backward");
}

}  // namespace
}  // namespace spincat
