// What the tests of every format share: reading text that stands in the test, and damaging it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/read_object.h"
#include "support/temp_dir.h"

namespace spincat::test {

inline Object read_bytes(const std::string& name, std::string_view bytes, const ReadLimits& limits = {}) {
  const TempDir dir;
  return read_object(dir.write(name, bytes), limits);
}

inline Mesh read_mesh(const std::string& name, std::string_view bytes) {
  return std::get<Mesh>(read_bytes(name, bytes));
}

inline PointCloud read_cloud(const std::string& name, std::string_view bytes) {
  return std::get<PointCloud>(read_bytes(name, bytes));
}

// What read_object says about bytes that it must refuse, without the file's name.
inline std::string problem_with(const std::string& name, std::string_view bytes, const ReadLimits& limits = {}) {
  try {
    read_bytes(name, bytes, limits);
  } catch (const InputError& error) {
    EXPECT_TRUE(error.file().ends_with(name)) << error.what();
    return error.problem();
  }
  return "(nothing thrown)";
}

inline void expect_near(const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-12) << i;
  }
}

inline bool all_finite(const std::vector<Vec3>& points) {
  for (const Vec3& point : points) {
    if (!point.allFinite()) {
      return false;
    }
  }
  return true;
}

inline void expect_sound(const Object& object) {
  if (const auto* cloud = std::get_if<PointCloud>(&object)) {
    EXPECT_FALSE(cloud->points.empty());
    EXPECT_TRUE(all_finite(cloud->points));
    EXPECT_TRUE(cloud->normals.empty() || cloud->normals.size() == cloud->points.size());
    return;
  }
  const Mesh& mesh = std::get<Mesh>(object);
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_TRUE(all_finite(mesh.vertices));
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      EXPECT_LT(corner, mesh.vertices.size());
    }
  }
}

// Reads what must give a sound object or an InputError with one line of words.
inline void expect_sound_or_refused(const TempDir& dir, const std::string& name, std::string_view bytes) {
  const std::filesystem::path file = dir.write(name, bytes);
  try {
    expect_sound(read_object(file));
  } catch (const InputError& error) {
    EXPECT_FALSE(error.problem().empty());
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
  std::filesystem::remove(file);  // overwriting thousands of times would wait for the disk each time
}

// Cuts a good file off at every byte, and changes every byte in a few ways.
inline void expect_survives_damage(const std::string& name, std::string_view good) {
  const TempDir dir;
  expect_sound(read_bytes(name, good));
  for (std::size_t size = 0; size < good.size(); ++size) {
    expect_sound_or_refused(dir, name, good.substr(0, size));
  }
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad(good);
    for (const char byte : {'\0', '\xff', '9', '-', '\n', ' ', static_cast<char>(good[at] ^ 1)}) {
      bad[at] = byte;
      expect_sound_or_refused(dir, name, bad);
    }
  }
}

}  // namespace spincat::test
