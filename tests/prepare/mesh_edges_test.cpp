#include "spincat/prepare/mesh_edges.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace spincat {
namespace {

std::vector<std::array<Side, 2>> shared_of(const Mesh& mesh) {
  std::vector<Side> sides;
  const std::vector<Triangle> corners = merged_corners(mesh);
  for (std::uint32_t f = 0; f < corners.size(); ++f) {
    add_sides(corners[f], f, sides);
  }
  return shared_edges(sides);
}

TEST(SharedEdges, OfABoxAreAllOfThem) {
  const auto shared = shared_of(test::box());
  EXPECT_EQ(shared.size(), 18U);
  for (const auto& [a, b] : shared) {
    EXPECT_LT(a.triangle, b.triangle);
    EXPECT_NE(a.forward, b.forward);  // all triangles look outwards
  }
  EXPECT_EQ(shared_of(test::soup_of(test::box())).size(), 18U);
}

TEST(SharedEdges, AreThoseOfTwoTrianglesAndNotOfThree) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(shared_of({corners, {{0, 1, 2}, {0, 1, 3}}}).size(), 1U);
  EXPECT_EQ(shared_of({corners, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}}).size(), 0U);
  EXPECT_TRUE(shared_edges({}).empty());
}

}  // namespace
}  // namespace spincat
