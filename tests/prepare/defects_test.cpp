#include "spincat/prepare/defects.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace spincat {
namespace {

using List = std::vector<std::uint32_t>;

void flip(Mesh& mesh, std::size_t f) {
  std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
}

TEST(Defects, ASoundMeshHasNone) {
  for (const Mesh& mesh : {test::box(), test::icosphere(2), test::soup_of(test::box())}) {
    const MeshDefects defects = defects_of(mesh);
    EXPECT_TRUE(defects.flat.empty());
    EXPECT_TRUE(defects.repeated.empty());
    EXPECT_TRUE(defects.flipped.empty());
  }
}

TEST(Defects, FlippedTrianglesAreTheMinority) {
  Mesh mesh = test::icosphere(1);
  flip(mesh, 0);
  flip(mesh, 17);
  EXPECT_EQ(defects_of(mesh).flipped, (List{0, 17}));
  EXPECT_EQ(defects_of(test::soup_of(mesh)).flipped, (List{0, 17}));  // by position, not by index
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    flip(mesh, f);
  }
  EXPECT_EQ(defects_of(mesh).flipped, (List{0, 17}));  // all turned round: inside out, but the same two differ
}

TEST(Defects, EachPartIsJudgedByItself) {
  Mesh inside_out = test::box();
  for (std::size_t f = 0; f < 12; ++f) {
    flip(inside_out, f);
  }
  Mesh apart = test::box();
  for (Vec3& v : apart.vertices) {
    v.x() += 9.0;
  }
  flip(apart, 3);
  EXPECT_EQ(defects_of(test::joined(inside_out, apart)).flipped, List{15});
}

TEST(Defects, OfTwoHalvesTheFirstTriangleIsRight) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}};
  EXPECT_EQ(defects_of(mesh).flipped, List{1});
}

TEST(Defects, FlatAndRepeatedOnesStandAside) {
  Mesh mesh = test::box();
  mesh.triangles.push_back({4, 6, 0});  // 12: face 0 again
  mesh.triangles.push_back({0, 6, 4});  // 13: and the other way round
  mesh.triangles.push_back({0, 0, 1});  // 14: flat
  mesh.triangles.push_back({0, 0, 1});  // 15: flat, not repeated
  const MeshDefects defects = defects_of(mesh);
  EXPECT_EQ(defects.repeated, (List{12, 13}));
  EXPECT_EQ(defects.flat, (List{14, 15}));
  EXPECT_TRUE(defects.flipped.empty());  // three at one edge would have cut the box into pieces
}

TEST(Defects, OfAnEmptyMesh) {
  EXPECT_TRUE(defects_of(Mesh{{{0, 0, 0}}, {}}).flipped.empty());
}

}  // namespace
}  // namespace spincat
