#include "spincat/io/write_object.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>

#include "spincat/io/read_object.h"
#include "support/expect_error.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;

// Coordinates of all sizes, and with all their digits.
PointCloud odd_cloud() {
  PointCloud cloud;
  for (int i = 1; i < 40; ++i) {
    cloud.points.emplace_back(1.0 / i, -std::sqrt(i) * 1e30, std::ldexp(1.0 / 3.0, -10 * i));
    cloud.normals.emplace_back(0.0, i, -0.1);
  }
  return cloud;
}

PointCloud read_again(const TempDir& dir, const char* name, const PointCloud& cloud) {
  write_object(dir.path() / name, cloud);
  return std::get<PointCloud>(read_object(dir.path() / name));
}

TEST(WriteObject, MeshesAreReadAsTheyWere) {
  const TempDir dir;
  Mesh mesh = test::box(1.0 / 3.0, 1e-30, 1e30);
  mesh.vertices.emplace_back(7, 8, 9);          // that no face uses
  mesh.triangles.push_back({3, 3, 4});          // without area
  mesh.triangles.push_back(mesh.triangles[0]);  // repeated
  write_object(dir.path() / "box.PLY", mesh);
  const auto again = std::get<Mesh>(read_object(dir.path() / "box.PLY"));
  EXPECT_EQ(again.vertices, mesh.vertices);
  EXPECT_EQ(again.triangles, mesh.triangles);
}

TEST(WriteObject, CloudsAreReadAsTheyWere) {
  const TempDir dir;
  for (const char* name : {"cloud.ply", "cloud.pcd"}) {
    PointCloud cloud = odd_cloud();
    EXPECT_EQ(read_again(dir, name, cloud).points, cloud.points) << name;
    EXPECT_EQ(read_again(dir, name, cloud).normals, cloud.normals) << name;
    cloud.normals.clear();
    EXPECT_EQ(read_again(dir, name, cloud).points, cloud.points) << name;
    EXPECT_TRUE(read_again(dir, name, cloud).normals.empty()) << name;
  }
}

TEST(WriteObject, MoreThanIsWrittenAtOnce) {
  const TempDir dir;
  PointCloud cloud;
  for (int i = 0; i < 100'000; ++i) {
    cloud.points.emplace_back(i, -i, 0.5 * i);
  }
  EXPECT_EQ(read_again(dir, "cloud.ply", cloud).points, cloud.points);
}

TEST(WriteObject, PcdKeepsTheSensorEvenAtTheOrigin) {
  const TempDir dir;
  PointCloud cloud = odd_cloud();
  EXPECT_FALSE(read_again(dir, "cloud.pcd", cloud).sensor);
  for (const Vec3& sensor : {Vec3(0, 0, 0), Vec3(0.1, -1e-9, 1e300)}) {
    cloud.sensor = sensor;
    EXPECT_EQ(read_again(dir, "cloud.pcd", cloud).sensor, sensor);
    EXPECT_FALSE(read_again(dir, "cloud.ply", cloud).sensor);
  }
}

TEST(WriteObject, RefusesOtherNames) {
  const TempDir dir;
  const auto message = [&](const char* name) {
    return input_error([&] { write_object(dir.path() / name, test::box()); });
  };
  const std::string place = dir.path().string() + "/";
  EXPECT_EQ(message("box.obj"), place + "box.obj: expected a name that ends in .ply or .pcd");
  EXPECT_EQ(message("box"), place + "box: expected a name that ends in .ply or .pcd");
  EXPECT_EQ(message("box.pcd"), place + "box.pcd: PCD files hold no faces; expected a name that ends in .ply");
  EXPECT_NE(message("none/box.ply"), "no error");
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

}  // namespace
}  // namespace spincat
