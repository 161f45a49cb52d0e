// What moves the vertices of a glTF file from where its buffers have them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/formats/gltf_square.h"

namespace spincat {
namespace {

using namespace test;
using nlohmann::json;

json sparse(json& document, int index_type, const std::string& indices, const std::string& values, std::size_t count) {
  const std::size_t index_view = add_view(document, indices), value_view = add_view(document, values);
  return {{"count", count},
          {"indices", {{"bufferView", index_view}, {"componentType", index_type}}},
          {"values", {{"bufferView", value_view}}}};
}

TEST(GltfSparse, ReplacesSomeValues) {
  for (const int type : {5121, 5123, 5125}) {
    const std::string indices = type == 5121   ? little_row<std::uint8_t>(1, 3)
                                : type == 5123 ? little_row<std::uint16_t>(1, 3)
                                               : little_row<std::uint32_t>(1, 3);
    json document = square_document();
    document["accessors"][0]["sparse"] = sparse(document, type, indices, floats(5, 6, 7, 8, 9, 10), 2);
    EXPECT_EQ(read_document(document).vertices, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {1, 1, 0}, {8, 9, 10}}));
  }
}

TEST(GltfSparse, HasABaseOfZerosWhereThereIsNone) {
  json document = square_document();
  document["accessors"][0].erase("bufferView");
  document["accessors"][0]["sparse"] =
      sparse(document, 5123, little_row<std::uint16_t>(1, 2, 3), floats(1, 0, 0, 1, 1, 0, 0, 1, 0), 3);
  expect_square(read_document(document));
}

TEST(GltfSparse, ReplacesIndicesToo) {
  json document = square_document();
  document["accessors"][1]["sparse"] =
      sparse(document, 5121, little_row<std::uint8_t>(5), little_row<std::uint16_t>(1), 1);
  EXPECT_EQ(read_document(document).triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}}));
}

TEST(GltfSparse, RefusesWhatIsDamaged) {
  const auto problem = [](int type, const std::string& indices, std::size_t count, const char* key, const json& value) {
    json document = square_document();
    json& accessor = document["accessors"][0];
    accessor["sparse"] = sparse(document, type, indices, floats(5, 6, 7, 8, 9, 10), count);
    if (key != nullptr) {
      accessor["sparse"]["values"][key] = value;
    }
    return problem_of(document);
  };
  const std::string good = little_row<std::uint16_t>(1, 3);
  EXPECT_EQ(problem(5123, good, 5, nullptr, {}), "its accessor 0 replaces 5 of its 4 values");
  EXPECT_EQ(problem(5123, good, 3, nullptr, {}), "its accessor 0 reaches beyond its bufferView");
  EXPECT_EQ(problem(5123, little_row<std::uint16_t>(1, 4), 2, nullptr, {}),
            "its accessor 0 replaces the value 4, which does not exist (4 do)");
  EXPECT_EQ(problem(5123, little_row<std::uint16_t>(3, 1), 2, nullptr, {}),
            "its accessor 0 replaces the value 1 after the value 3");
  EXPECT_EQ(problem(5123, little_row<std::uint16_t>(1, 1), 2, nullptr, {}),
            "its accessor 0 replaces the value 1 after the value 1");
  EXPECT_EQ(problem(5126, floats(1, 3), 2, nullptr, {}),
            "its accessor 0 names the values that it replaces by numbers that are no indices");
  EXPECT_EQ(problem(5123, good, 2, "byteOffset", 4), "its accessor 0 reaches beyond its bufferView");
  EXPECT_EQ(problem(5123, good, 2, "bufferView", 99), "its bufferView 99 does not exist (4 do)");
}

// A few bytes name any number of vertices.
TEST(GltfSparse, BoundsWhatHasNoBase) {
  json document = square_document();
  document["accessors"][0].erase("bufferView");
  document["accessors"][0]["count"] = 50'000'000;
  document["accessors"][0]["sparse"] = sparse(document, 5121, little_row<std::uint8_t>(1), floats(5, 6, 7), 1);
  const std::string problem = problem_of(document);
  EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
}

json square_with_target() {
  json document = square_document();
  const std::size_t target = add_accessor(document, floats(0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4), 5126, "VEC3", 4);
  document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
  return document;
}

TEST(GltfMorph, AppliesTheWeightsOfTheMesh) {
  json document = square_with_target();
  document["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(read_document(document).vertices, (std::vector<Vec3>{{0, 0, 0.5}, {1, 0, 1}, {1, 1, 1.5}, {0, 1, 2}}));
}

TEST(GltfMorph, PrefersTheWeightsOfTheNode) {
  json document = square_with_target();
  document["meshes"][0]["weights"] = {0.5};
  document["nodes"][0]["weights"] = {0.0};
  expect_square(read_document(document));
  document["nodes"][0]["weights"] = {2.0};
  document["nodes"][0]["translation"] = {10, 0, 0};
  EXPECT_EQ(read_document(document).vertices[3], Vec3(10, 1, 8));
}

TEST(GltfMorph, IsAtRestWithoutWeights) {
  expect_square(read_document(square_with_target()));
}

TEST(GltfMorph, AddsTargetsUp) {
  json document = square_with_target();
  json& primitive = document["meshes"][0]["primitives"][0];
  const json first = primitive["targets"][0];
  document["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
  const std::size_t second = document["accessors"].size() - 1;
  document["accessors"][second]["sparse"] = sparse(document, 5121, little_row<std::uint8_t>(2), floats(7, 0, 0), 1);
  primitive["targets"] = {first, {{"NORMAL", 0}}, {{"POSITION", second}}};
  document["meshes"][0]["weights"] = {1, 1, -1};
  EXPECT_EQ(read_document(document).vertices, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 2}, {-6, 1, 3}, {0, 1, 4}}));
}

TEST(GltfMorph, RefusesTargetsOfAnotherLength) {
  json document = square_with_target();
  document["meshes"][0]["weights"] = {1};
  document["accessors"][2]["count"] = 3;
  EXPECT_EQ(problem_of(document), "its accessor 2 holds 3 values for 4 vertices");
}

// Primitives that share their positions but not their targets.
TEST(GltfMorph, KeepsPrimitivesApart) {
  json document = square_with_target();
  json plain = document["meshes"][0]["primitives"][0];
  plain.erase("targets");
  document["meshes"][0]["primitives"].push_back(plain);
  document["meshes"][0]["weights"] = {1};
  const Mesh mesh = read_document(document);
  ASSERT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.vertices[3], Vec3(0, 1, 4));
  EXPECT_EQ(mesh.vertices[7], Vec3(0, 1, 0));
}

// Two joints: vertices 0 and 1 belong to the first, 2 and 3 to the second.
json square_with_skin() {
  json document = square_document();
  const std::size_t joints =
      add_accessor(document, little_row<std::uint8_t>(0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0), 5121, "VEC4", 4);
  const std::size_t weights =
      add_accessor(document, floats(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0), 5126, "VEC4", 4);
  document["meshes"][0]["primitives"][0]["attributes"].update({{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
  document["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                       {{"children", {2}}, {"translation", {1, 0, 0}}},
                       {{"translation", {0, 0, 5}}, {"scale", {2, 2, 2}}}};
  document["scenes"][0]["nodes"] = {0, 1};
  document["skins"] = {{{"joints", {1, 2}}}};
  return document;
}

TEST(GltfSkin, PlacesVerticesByTheirJointsAndNotByTheirNode) {
  EXPECT_EQ(read_document(square_with_skin()).vertices,
            (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {3, 2, 5}, {1, 2, 5}}));
}

TEST(GltfSkin, AppliesTheInverseBindMatrices) {
  json document = square_with_skin();
  const std::string identity = floats(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  const std::string moved = floats(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1);  // by columns
  document["skins"][0]["inverseBindMatrices"] = add_accessor(document, identity + moved, 5126, "MAT4", 2);
  EXPECT_EQ(read_document(document).vertices, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {3, 0, 5}, {1, 0, 5}}));
  document["accessors"].back()["count"] = 1;
  EXPECT_EQ(problem_of(document), "its accessor 4 holds 1 matrices for 2 joints");
}

TEST(GltfSkin, MixesJointsByWeightsOfAnyType) {
  json document = square_with_skin();
  document["accessors"][2]["bufferView"] =
      add_view(document, little_row<std::uint8_t>(0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0));
  // 51 of 255 is a fifth; what does not add up to 1 is weighed as if it did.
  document["accessors"][3].update({{"componentType", 5121}, {"normalized", true}});
  document["accessors"][3]["bufferView"] =
      add_view(document, little_row<std::uint8_t>(204, 51, 0, 0, 102, 102, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0));
  expect_near(read_document(document).vertices, {{1, 0, 1}, {2.5, 0, 2.5}, {2, 1, 0}, {0, 1, 0}});
}

TEST(GltfSkin, ReadsMoreThanFourJointsOfAVertex) {
  json document = square_with_skin();
  json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
  EXPECT_EQ(read_document(document).vertices[2], Vec3(3, 2, 5));
}

TEST(GltfSkin, RefusesWhatIsDamaged) {
  json document = square_with_skin();
  document["skins"][0]["joints"] = {1};
  EXPECT_EQ(problem_of(document), "its accessor 2 holds the joint 1, which is out of range (1 joints)");
  document["skins"][0]["joints"] = {1, 9};
  EXPECT_EQ(problem_of(document), "its node 9 does not exist (3 do)");
  document["nodes"][0]["skin"] = 3;
  EXPECT_EQ(problem_of(document), "its skin 3 does not exist (1 do)");
  document = square_with_skin();
  document["accessors"][3]["count"] = 3;
  EXPECT_EQ(problem_of(document), "its accessor 3 holds 3 values for 4 vertices");
}

// Joints may stand in a circle that no scene shows.
TEST(GltfSkin, EndsCirclesOfJoints) {
  json document = square_with_skin();
  document["nodes"][2]["children"] = {1};
  document["scenes"][0]["nodes"] = {0};
  EXPECT_EQ(read_document(document).vertices.size(), 4U);
}

TEST(GltfSkin, TurnsMirroredFacesBack) {
  json document = square_with_skin();
  document["nodes"][1]["scale"] = {-1, 1, 1};
  EXPECT_EQ(read_document(document).triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}}));
}

// The same skin for many nodes; many targets of one accessor: neither may take more time than memory would allow.
TEST(GltfSkin, BoundsTargetsThatAreRepeated) {
  json document = square_document();
  constexpr std::size_t vertices = 40'000;
  document["accessors"][0].update(
      {{"bufferView", add_view(document, std::string(12 * vertices, '\0'))}, {"count", vertices}});
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  for (int i = 0; i < 2'000; ++i) {
    primitive["targets"].push_back({{"POSITION", 0}});
    document["meshes"][0]["weights"].push_back(1);
  }
  const std::string problem = problem_of(document);
  EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
}

json square_with_instances() {
  json document = square_document();
  const std::size_t places = add_accessor(document, floats(0, 0, 0, 0, 0, 5), 5126, "VEC3", 2);
  document["nodes"][0]["translation"] = {1, 0, 0};
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places}};
  document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return document;
}

TEST(GltfInstances, ShowTheMeshOfANodeSeveralTimes) {
  const Mesh mesh = read_document(square_with_instances());
  ASSERT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.vertices[1], Vec3(2, 0, 0));
  EXPECT_EQ(mesh.vertices[5], Vec3(2, 0, 5));
}

TEST(GltfInstances, AreTurnedAndScaled) {
  json document = square_with_instances();
  json& attributes = document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  // The second is turned by 180 degrees around z, as numbers of a byte.
  attributes["ROTATION"] = add_accessor(document, little_row<std::int8_t>(0, 0, 0, 127, 0, 0, 127, 0), 5120, "VEC4", 2);
  document["accessors"].back()["normalized"] = true;
  attributes["SCALE"] = add_accessor(document, floats(1, 1, 1, 2, 3, 1), 5126, "VEC3", 2);
  attributes["_COLOR"] = 99;
  const Mesh mesh = read_document(document);
  expect_near({mesh.vertices[2], mesh.vertices[6]}, {{2, 1, 0}, {-1, -3, 5}});
}

TEST(GltfInstances, AreOfOneNumber) {
  json document = square_with_instances();
  json& attributes = document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["SCALE"] = add_accessor(document, floats(1, 1, 1), 5126, "VEC3", 1);
  EXPECT_EQ(problem_of(document), "its accessor 3 holds 1 values for 2 instances");
  attributes = {{"TRANSLATION", 99}};
  EXPECT_EQ(problem_of(document), "its accessor 99 does not exist (4 do)");
}

TEST(GltfInstances, AreBounded) {
  json document = square_with_instances();
  document["accessors"][2].erase("bufferView");
  document["accessors"][2]["count"] = 1'000'000'000;
  document["accessors"][2]["sparse"] = sparse(document, 5121, little_row<std::uint8_t>(1), floats(5, 6, 7), 1);
  for (const bool empty : {false, true}) {
    if (empty) {
      document["meshes"][0]["primitives"] = json::array();
    }
    const std::string problem = problem_of(document);
    EXPECT_TRUE(problem.starts_with("would take ") || problem.starts_with("is no valid glTF")) << problem;
  }
}

TEST(GltfVisibility, HidesANodeAndAllBelowIt) {
  json document = square_document();
  document["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"mesh", 0}, {"translation", {9, 0, 0}}}};
  document["scenes"][0]["nodes"] = {0, 1};
  document["nodes"][1]["extensions"]["KHR_node_visibility"] = {{"visible", true}};
  EXPECT_EQ(read_document(document).vertices.size(), 8U);
  document["nodes"][1]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
  expect_square(read_document(document));
}

TEST(GltfShape, SurvivesDamage) {
  json document = square_with_skin();
  document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  document["meshes"][0]["weights"] = {1};
  expect_survives_damage("a.gltf", document.dump());
  expect_survives_damage("a.gltf", square_with_instances().dump());
}

}  // namespace
}  // namespace spincat
