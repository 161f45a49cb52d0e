#include "spincat/background/background_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <set>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

// A number of all coordinates and corners, bit by bit.
std::uint64_t digest(const Mesh& mesh) {
  std::uint64_t sum = mesh.vertices.size();
  for (const Vec3& v : mesh.vertices) {
    for (const double x : v) {
      sum = derive_seed(sum, std::bit_cast<std::uint64_t>(x));
    }
  }
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) {
      sum = derive_seed(sum, corner);
    }
  }
  return sum;
}

// The sides of the bounding box, the longest first.
Vec3 extents(const Mesh& mesh) {
  Vec3 low = mesh.vertices.front();
  Vec3 high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  Vec3 size = high - low;
  std::sort(size.begin(), size.end(), std::greater<>());
  return size;
}

TEST(BackgroundShapes, AreSoundMeshesWithDepth) {
  for (std::uint32_t number = 0; number < kBackgroundShapes; ++number) {
    const Mesh mesh = background_shape(number);
    ASSERT_FALSE(mesh.triangles.empty()) << number;
    EXPECT_LE(mesh.triangles.size(), 20'000U) << number;
    for (const Vec3& v : mesh.vertices) {
      ASSERT_TRUE(v.allFinite()) << number;
    }
    for (const Triangle& t : mesh.triangles) {
      ASSERT_LT(*std::max_element(t.begin(), t.end()), mesh.vertices.size()) << number;
    }
    const Vec3 size = extents(mesh);
    EXPECT_LT(size[0], 20.0) << number;
    EXPECT_GT(size[1], 0.02 * size[0]) << number;
    EXPECT_GT(size[2], 0.0) << number;
  }
}

TEST(BackgroundShapes, NoTwoAreTheSame) {
  std::set<std::uint64_t> digests;
  for (std::uint32_t number = 0; number < kBackgroundShapes; ++number) {
    digests.insert(digest(background_shape(number)));
  }
  EXPECT_EQ(digests.size(), kBackgroundShapes);
}

TEST(BackgroundShapes, AShapeIsTheSameEachTime) {
  for (std::uint32_t number = 0; number < kBackgroundShapes; ++number) {
    ASSERT_EQ(digest(background_shape(number)), digest(background_shape(number))) << number;
  }
}

}  // namespace
}  // namespace spincat
